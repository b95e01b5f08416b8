#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include <quadrille/bodies.hpp>

#include "collision/contact_law.hpp"
#include "collision/partitioner.hpp"

namespace quadrille {

/// Two moving bodies, by row; the first was created first.
struct MovingPair {
    std::uint32_t a, b;
};

/// A moving body and a static one, each by its row among its kind.
struct StaticPair {
    std::uint32_t a, fixed;
};

/// Sums of half extents when all moving bodies have one size.
template <class Real>
struct UniformSizes {
    Real halfWidth, halfHeight;

    explicit UniformSizes(const BodyView<Real>& bodies)
        : halfWidth(bodies.moving.halfWidth.common), halfHeight(bodies.moving.halfHeight.common) {}
    Real width(std::size_t) const { return halfWidth; }
    Real height(std::size_t) const { return halfHeight; }
};

/// The same when they have sizes of their own.
template <class Real>
struct OwnSizes {
    ColumnView<Real> halfWidth, halfHeight;

    explicit OwnSizes(const BodyView<Real>& bodies)
        : halfWidth(bodies.moving.halfWidth), halfHeight(bodies.moving.halfHeight) {}
    Real width(std::size_t row) const { return halfWidth[row]; }
    Real height(std::size_t row) const { return halfHeight[row]; }
};

/// Calls `function` with the sizes of the scene, so that one loop serves both kinds.
template <class Real, class Function>
decltype(auto) withSizes(const BodyView<Real>& bodies, Function&& function) {
    if (bodies.moving.halfWidth.uniform() && bodies.moving.halfHeight.uniform()) {
        return function(UniformSizes<Real>(bodies));
    }
    return function(OwnSizes<Real>(bodies));
}

/// Finds the pairs of bodies that overlap, each exactly once.
///
/// While a partition keeps its cells for several steps (it has a margin), the pairs whose inflated
/// boxes overlap are collected once and only these are tested in each step.
template <class Real>
class NarrowPhase {
  public:
    /// Calls `onMoving(MovingPair, reachX, reachY)` and `onStatic(StaticPair, reachX, reachY)` for
    /// every overlapping pair; from an incomplete partition a pair may come more than once. Returns
    /// the number of pairs tested.
    template <class OnMoving, class OnStatic>
    std::uint64_t find(const BodyView<Real>& bodies, const Partition<Real>& partition,
                       OnMoving&& onMoving, OnStatic&& onStatic) {
        return withSizes(bodies, [&](const auto& sizes) -> std::uint64_t {
            if (partition.margin > 0) {
                if (collected_ != partition.generation) collect(bodies, partition, sizes);
                return testCandidates(bodies, sizes, onMoving, onStatic);
            }
            return walkCells(bodies, partition, sizes, Real(0), onMoving, onStatic);
        });
    }

    std::size_t bytes() const {
        return moving_.capacity() * sizeof(MovingPair) + static_.capacity() * sizeof(StaticPair) +
               (x_.capacity() + y_.capacity() + width_.capacity() + height_.capacity()) *
                   sizeof(Real);
    }

  private:
    template <class Sizes>
    void collect(const BodyView<Real>& bodies, const Partition<Real>& partition,
                 const Sizes& sizes) {
        moving_.clear();
        static_.clear();
        // A little more than the margins of both, for the rounding of the distances walked since.
        const Real inflation =
            2 * partition.margin * (1 + 16 * std::numeric_limits<Real>::epsilon());
        walkCells(
            bodies, partition, sizes, inflation,
            [&](MovingPair pair, Real, Real) { moving_.push_back(pair); },
            [&](StaticPair pair, Real, Real) { static_.push_back(pair); });
        collected_ = partition.generation;
    }

    template <class Sizes, class OnMoving, class OnStatic>
    std::uint64_t testCandidates(const BodyView<Real>& bodies, const Sizes& sizes,
                                 OnMoving&& onMoving, OnStatic&& onStatic) const {
        const auto& m = bodies.moving;
        const auto& f = bodies.fixed;
        const Real* x = m.x.data();
        const Real* y = m.y.data();
        for (const MovingPair pair : moving_) {
            const Real reachX = sizes.width(pair.a) + sizes.width(pair.b);
            const Real reachY = sizes.height(pair.a) + sizes.height(pair.b);
            if (overlaps(x[pair.b] - x[pair.a], y[pair.b] - y[pair.a], reachX, reachY)) {
                onMoving(pair, reachX, reachY);
            }
        }
        for (const StaticPair pair : static_) {
            const Real reachX = sizes.width(pair.a) + f.halfWidth[pair.fixed];
            const Real reachY = sizes.height(pair.a) + f.halfHeight[pair.fixed];
            if (overlaps(f.x[pair.fixed] - x[pair.a], f.y[pair.fixed] - y[pair.a], reachX,
                         reachY)) {
                onStatic(pair, reachX, reachY);
            }
        }
        return moving_.size() + static_.size();
    }

    /// All pairs of every cell; `inflation` is added to every sum of half extents.
    template <class Sizes, class OnMoving, class OnStatic>
    std::uint64_t walkCells(const BodyView<Real>& bodies, const Partition<Real>& partition,
                            const Sizes& sizes, Real inflation, OnMoving&& onMoving,
                            OnStatic&& onStatic) {
        const auto& m = bodies.moving;
        const auto& f = bodies.fixed;
        const Cells& cells = partition.cells;
        const auto movingCount = static_cast<std::uint32_t>(m.size());
        std::uint64_t tested = 0;
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const auto members = cells[c];
            if (members.size() < 2) continue;
            // Members ascend, so the static ones stand last.
            std::size_t moving = members.size();
            while (moving > 0 && members[moving - 1] >= movingCount) --moving;
            if (moving == 0) continue;
            gather(m, sizes, members.first(moving));
            const auto owned = [&](std::uint32_t a, std::uint32_t b) {
                return !partition.complete || partition.owns(c, a, b);
            };
            for (std::size_t i = 0; i + 1 < moving; ++i) {
                const Box box{x_[i], y_[i], width_[i] + inflation, height_[i] + inflation};
                forEachHit(box, i + 1, moving, [&](std::size_t j) {
                    if (!owned(members[i], members[j])) return;
                    onMoving(MovingPair{members[i], members[j]}, width_[i] + width_[j],
                             height_[i] + height_[j]);
                });
            }
            for (std::size_t k = moving; k < members.size(); ++k) {
                const std::uint32_t fixed = members[k] - movingCount;
                const Box box{f.x[fixed], f.y[fixed], f.halfWidth[fixed] + inflation,
                              f.halfHeight[fixed] + inflation};
                forEachHit(box, 0, moving, [&](std::size_t i) {
                    if (!owned(members[i], members[k])) return;
                    onStatic(StaticPair{members[i], fixed}, width_[i] + f.halfWidth[fixed],
                             height_[i] + f.halfHeight[fixed]);
                });
            }
            tested += moving * (moving - 1) / 2 + moving * (members.size() - moving);
        }
        return tested;
    }

    /// A centre and half extents.
    struct Box {
        Real x, y, halfWidth, halfHeight;
    };

    /// Boxes are compared in blocks of as many as the widest vector registers hold: a loop of fixed
    /// length over contiguous memory that compilers turn into a few instructions.
    static constexpr std::size_t block = 64 / sizeof(Real);
    using Bits = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;

    /// Calls `function(j)` for each gathered box from `first` to `last` that `box` overlaps.
    template <class Function>
    void forEachHit(const Box& box, std::size_t first, std::size_t last,
                    Function&& function) const {
        for (std::size_t start = first / block * block; start < last; start += block) {
            const Real* const x = x_.data() + start;
            const Real* const y = y_.data() + start;
            const Real* const width = width_.data() + start;
            const Real* const height = height_.data() + start;
            Bits hits = 0;
            for (std::size_t l = 0; l < block; ++l) {
                const bool hit = overlaps(x[l] - box.x, y[l] - box.y, box.halfWidth + width[l],
                                          box.halfHeight + height[l]);
                hits |= hit ? Bits(1) << l : Bits(0);
            }
            if (start < first) hits &= ~Bits(0) << (first - start);
            for (; hits != 0; hits &= hits - 1) {
                function(start + static_cast<std::size_t>(std::countr_zero(hits)));
            }
        }
    }

    /// Brings the boxes of a cell together, and fills up the last block with boxes that nothing
    /// overlaps.
    template <class Sizes>
    void gather(const typename BodyView<Real>::Moving& m, const Sizes& sizes,
                std::span<const std::uint32_t> members) {
        const std::size_t padded = (members.size() + block - 1) / block * block;
        if (padded > x_.size()) {
            for (auto* column : {&x_, &y_, &width_, &height_}) column->resize(2 * padded);
        }
        std::size_t i = 0;
        for (; i < members.size(); ++i) {
            x_[i] = m.x[members[i]];
            y_[i] = m.y[members[i]];
            width_[i] = sizes.width(members[i]);
            height_[i] = sizes.height(members[i]);
        }
        for (; i < padded; ++i) {
            x_[i] = std::numeric_limits<Real>::infinity();
            y_[i] = width_[i] = height_[i] = 0;
        }
    }

    std::vector<MovingPair> moving_;  // candidates
    std::vector<StaticPair> static_;
    std::uint64_t collected_ = 0;  // generation of the partition that they come from
    std::vector<Real> x_, y_, width_, height_;
};

}  // namespace quadrille
