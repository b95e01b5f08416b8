#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <quadrille/bodies.hpp>

#include "collision/broad/partitioner.hpp"
#include "collision/pairs/candidate_pairs.hpp"
#include "collision/pairs/cell_walk.hpp"
#include "collision/pairs/hit_bits.hpp"
#include "collision/rules/pair_contact.hpp"
#include "collision/rules/pair_geometry.hpp"

namespace quadrille {

/// Calls `onMoving(MovingPair)` for those of the pairs that overlap.
template <class Real, class Sizes, class OnMoving>
void testMoving(const BodyView<Real>& bodies, const Sizes& sizes, std::span<const MovingPair> pairs,
                OnMoving&& onMoving) {
    const Real* const x = bodies.moving.x.data();
    const Real* const y = bodies.moving.y.data();
    // Not by way of two boxes: with sizes of their own, g++ then finds no vector code.
    const auto touch = [&](MovingPair p) {
        return overlaps(x[p.b] - x[p.a], y[p.b] - y[p.a], sizes.width(p.a) + sizes.width(p.b),
                        sizes.height(p.a) + sizes.height(p.b));
    };
    const MovingPair* pair = pairs.data();
    const MovingPair* const end = pair + pairs.size();
    for (; end - pair >= static_cast<std::ptrdiff_t>(hitBlock<Real>); pair += hitBlock<Real>) {
        forEachBit(hitBits<Real>([&](std::size_t l) { return touch(pair[l]); }),
                   [&](std::size_t l) { onMoving(pair[l]); });
    }
    for (; pair != end; ++pair) {
        if (touch(*pair)) onMoving(*pair);
    }
}

/// Calls `onStatic(StaticPair)` for those of the pairs that overlap.
template <class Real, class Sizes, class OnStatic>
void testStatic(const BodyView<Real>& bodies, const Sizes& sizes, std::span<const StaticPair> pairs,
                OnStatic&& onStatic) {
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    for (const StaticPair p : pairs) {
        const Box<Real> a{m.x[p.a], m.y[p.a], sizes.width(p.a), sizes.height(p.a)};
        const Box<Real> b{f.x[p.fixed], f.y[p.fixed], f.halfWidth[p.fixed], f.halfHeight[p.fixed]};
        if (overlap(a, b)) onStatic(p);
    }
}

/// Turns the hits that a walk through cells hands out into calls of `onMoving(MovingPair)`.
template <class OnMoving>
auto asPairs(OnMoving& onMoving) {
    return [&onMoving](std::uint32_t a, const BodyRef* others, auto hits) {
        forEachBit(hits, [&](std::size_t l) { onMoving(MovingPair{a, others[l].row()}); });
    };
}

/// Finds the pairs of bodies that overlap, each exactly once. While a partition keeps its cells for
/// several steps (it has a margin), only the candidate pairs are tested in each step.
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
                return walk_.walk(bodies, partition, sizes, Real(0), 0, partition.cells.size(),
                                  asPairs(onMoving), onStatic);
            }
            candidates_.update(bodies, partition);
            testMoving(bodies, sizes, candidates_.moving(), onMoving);
            testStatic(bodies, sizes, candidates_.fixed(), onStatic);
            return candidates_.size();
        });
    }

    std::size_t bytes() const { return walk_.bytes() + candidates_.bytes(); }

  private:
    CellWalk<Real> walk_;
    CandidatePairs<Real> candidates_;
};

}  // namespace quadrille
