#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <quadrille/bodies.hpp>

#include "collision/cell_walk.hpp"
#include "collision/hit_bits.hpp"
#include "collision/partitioner.hpp"

namespace quadrille {

/// What is added to the sums of half extents when candidate pairs are collected: a little more than
/// the margins of both, for the rounding of the distances walked since and of the sums themselves.
template <class Real>
Real candidateInflation(const BodyView<Real>& bodies, Real margin) {
    Real largest = std::max(bodies.moving.halfWidth.common, bodies.moving.halfHeight.common);
    for (const auto values : {bodies.moving.halfWidth.values, bodies.moving.halfHeight.values,
                              bodies.fixed.halfWidth, bodies.fixed.halfHeight}) {
        for (const Real value : values) largest = std::max(largest, value);
    }
    constexpr Real eps = 16 * std::numeric_limits<Real>::epsilon();
    return 2 * margin * (1 + eps) + largest * eps;
}

/// The pairs whose boxes overlap when each is inflated by the margin of the partition: all that can
/// meet before the partition is rebuilt (Verlet 1967).
template <class Real>
class CandidatePairs {
  public:
    /// Collects the pairs anew if the partition was built since the last call. Returns whether it
    /// did.
    bool update(const BodyView<Real>& bodies, const Partition<Real>& partition) {
        if (collected_ == partition.generation) return false;
        withSizes(bodies, [&](const auto& sizes) { collect(bodies, partition, sizes); });
        collected_ = partition.generation;
        return true;
    }

    std::span<const MovingPair> moving() const { return {moving_.data(), movingCount_}; }
    std::span<const StaticPair> fixed() const { return fixed_; }
    std::size_t size() const { return movingCount_ + fixed_.size(); }

    std::size_t bytes() const {
        return moving_.capacity() * sizeof(MovingPair) + fixed_.capacity() * sizeof(StaticPair) +
               walk_.bytes();
    }

  private:
    using Bits = HitBits<Real>;

    template <class Sizes>
    void collect(const BodyView<Real>& bodies, const Partition<Real>& partition,
                 const Sizes& sizes) {
        movingCount_ = 0;
        fixed_.clear();
        walk_.walk(
            bodies, partition, sizes, candidateInflation(bodies, partition.margin),
            [&](std::uint32_t a, const std::uint32_t* others, Bits hits) {
                append(a, others, hits);
            },
            [&](StaticPair p) { fixed_.push_back(p); });
    }

    /// Most bodies have up to two neighbours in a block, and how many is a coin toss that a branch
    /// would lose: two pairs are written always, and counted if they are there.
    void append(std::uint32_t a, const std::uint32_t* others, Bits hits) {
        if (moving_.size() < movingCount_ + hitBlock<Real>) {
            moving_.resize(std::max<std::size_t>(1024, moving_.size() + moving_.size() / 2));
        }
        const auto put = [&] {
            // An empty mask has no lowest bit; what is then written is not counted.
            const auto lowest = static_cast<std::size_t>(std::countr_zero(hits | lastBit));
            moving_[movingCount_] = {a, others[hits != 0 ? lowest : 0]};
            movingCount_ += hits != 0;
            hits &= hits - 1;
        };
        put();
        put();
        while (hits != 0) put();
    }

    static constexpr Bits lastBit = Bits(1) << (hitBlock<Real> - 1);

    CellWalk<Real> walk_;
    std::vector<MovingPair> moving_;  // the first movingCount_
    std::size_t movingCount_ = 0;
    std::vector<StaticPair> fixed_;
    std::uint64_t collected_ = 0;  // generation of the partition that the pairs come from
};

}  // namespace quadrille
