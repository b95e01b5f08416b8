#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include <quadrille/bodies.hpp>

#include "collision/cell_walk.hpp"
#include "collision/contact_law.hpp"
#include "collision/hit_bits.hpp"
#include "collision/partitioner.hpp"

namespace quadrille {

/// Finds the pairs of bodies that overlap, each exactly once.
///
/// While a partition keeps its cells for several steps (it has a margin), the pairs whose inflated
/// boxes overlap are collected once and only these are tested in each step (Verlet 1967).
template <class Real>
class NarrowPhase {
  public:
    /// Calls `onMoving(MovingPair)` and `onStatic(StaticPair)` for every overlapping pair; from an
    /// incomplete partition a pair may come more than once. Returns the number of pairs tested.
    template <class OnMoving, class OnStatic>
    std::uint64_t find(const BodyView<Real>& bodies, const Partition<Real>& partition,
                       OnMoving&& onMoving, OnStatic&& onStatic) {
        return withSizes(bodies, [&](const auto& sizes) -> std::uint64_t {
            if (!(partition.margin > 0)) {
                const auto each = [&](std::uint32_t a, const std::uint32_t* others, Bits hits) {
                    forEachBit(hits, [&](std::size_t l) { onMoving(MovingPair{a, others[l]}); });
                };
                return walk_.walk(bodies, partition, sizes, Real(0), each, onStatic);
            }
            if (collected_ != partition.generation) collect(bodies, partition, sizes);
            testMoving(bodies, sizes, onMoving);
            testStatic(bodies, sizes, onStatic);
            return movingCount_ + static_.size();
        });
    }

    std::size_t bytes() const {
        return moving_.capacity() * sizeof(MovingPair) + static_.capacity() * sizeof(StaticPair) +
               walk_.bytes();
    }

  private:
    using Bits = HitBits<Real>;

    template <class Sizes>
    void collect(const BodyView<Real>& bodies, const Partition<Real>& partition,
                 const Sizes& sizes) {
        movingCount_ = 0;
        static_.clear();
        // A little more than the margins of both, for the rounding of the distances walked since.
        const Real inflation =
            2 * partition.margin * (1 + 16 * std::numeric_limits<Real>::epsilon());
        walk_.walk(
            bodies, partition, sizes, inflation,
            [&](std::uint32_t a, const std::uint32_t* others, Bits hits) {
                append(a, others, hits);
            },
            [&](StaticPair p) { static_.push_back(p); });
        collected_ = partition.generation;
    }

    /// Most bodies have up to two neighbours in a block, and how many is a coin toss that a branch
    /// would lose: two pairs are written always, and counted if they are there.
    void append(std::uint32_t a, const std::uint32_t* others, Bits hits) {
        if (movingCount_ + hitBlock < Real >> moving_.size()) {
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

    template <class Sizes, class OnMoving>
    void testMoving(const BodyView<Real>& bodies, const Sizes& sizes, OnMoving&& onMoving) const {
        const Real* const x = bodies.moving.x.data();
        const Real* const y = bodies.moving.y.data();
        const auto touch = [&](MovingPair p) {
            return overlaps(x[p.b] - x[p.a], y[p.b] - y[p.a], sizes.width(p.a) + sizes.width(p.b),
                            sizes.height(p.a) + sizes.height(p.b));
        };
        const MovingPair* pair = moving_.data();
        const MovingPair* const end = pair + movingCount_;
        for (; end - pair >= static_cast<std::ptrdiff_t>(hitBlock<Real>); pair += hitBlock<Real>) {
            forEachBit(hitBits<Real>([&](std::size_t l) { return touch(pair[l]); }),
                       [&](std::size_t l) { onMoving(pair[l]); });
        }
        for (; pair != end; ++pair) {
            if (touch(*pair)) onMoving(*pair);
        }
    }

    template <class Sizes, class OnStatic>
    void testStatic(const BodyView<Real>& bodies, const Sizes& sizes, OnStatic&& onStatic) const {
        const auto& m = bodies.moving;
        const auto& f = bodies.fixed;
        for (const StaticPair p : static_) {
            if (overlaps(f.x[p.fixed] - m.x[p.a], f.y[p.fixed] - m.y[p.a],
                         sizes.width(p.a) + f.halfWidth[p.fixed],
                         sizes.height(p.a) + f.halfHeight[p.fixed])) {
                onStatic(p);
            }
        }
    }

    CellWalk<Real> walk_;
    // Candidates, and the generation of the partition that they come from.
    std::vector<MovingPair> moving_;  // the first movingCount_
    std::size_t movingCount_ = 0;
    std::vector<StaticPair> static_;
    std::uint64_t collected_ = 0;
};

}  // namespace quadrille
