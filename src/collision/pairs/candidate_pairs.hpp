#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <quadrille/bodies.hpp>

#include "collision/broad/extents.hpp"
#include "collision/broad/partitioner.hpp"
#include "collision/pairs/cell_walk.hpp"
#include "collision/pairs/hit_bits.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// The pairs whose boxes overlap when each is inflated by the margin of the partition: all that can
/// meet before the partition is rebuilt (Verlet 1967).
template <class Real>
class CandidatePairs {
  public:
    /// Collects the pairs anew if the partition was built since the last call. Returns whether it
    /// did.
    bool update(const BodyView<Real>& bodies, const Partition<Real>& partition) {
        if (collected_ == partition.generation) return false;
        clear();
        add(bodies, partition, inflationOf(bodies, partition), 0, partition.cells.size());
        collected_ = partition.generation;
        return true;
    }

    // ---- or, where several lists share a partition, each with some of its cells

    void clear() {
        movingCount_ = 0;
        fixed_.clear();
    }

    void add(const BodyView<Real>& bodies, const Partition<Real>& partition, Real inflation,
             std::size_t firstCell, std::size_t lastCell) {
        const auto onMoving = [&](std::uint32_t a, const BodyRef* others, Bits hits) {
            append(a, others, hits);
        };
        withSizes(bodies, [&](const auto& sizes) {
            walk_.walk(bodies, partition, sizes, inflation, firstCell, lastCell, onMoving,
                       [&](StaticPair p) { fixed_.push_back(p); });
        });
    }

    /// What to add to the sums of half extents.
    static Real inflationOf(const BodyView<Real>& bodies, const Partition<Real>& partition,
                            const ThreadTeam& team = ThreadTeam::serial()) {
        return candidateInflation(partition.margin,
                                  largestHalfExtent(bodies, team) + partition.largestExtra());
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

    /// Most bodies have up to two neighbours in a block, and how many is a coin toss that a branch
    /// would lose: two pairs are written always, and counted if they are there.
    void append(std::uint32_t a, const BodyRef* others, Bits hits) {
        if (moving_.size() < movingCount_ + hitBlock<Real>) {
            moving_.resize(std::max<std::size_t>(1024, moving_.size() + moving_.size() / 2));
        }
        const auto put = [&] {
            // An empty mask has no lowest bit; what is then written is not counted.
            const auto lowest = static_cast<std::size_t>(std::countr_zero(hits | lastBit));
            moving_[movingCount_] = {a, others[hits != 0 ? lowest : 0].row()};
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
