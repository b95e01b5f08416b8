#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <quadrille/bodies.hpp>

#include "collision/broad/partitioner.hpp"
#include "collision/pairs/hit_bits.hpp"
#include "collision/rules/pair_geometry.hpp"

namespace quadrille {

/// Two moving bodies, by row, in no order.
struct MovingPair {
    std::uint32_t a, b;
};

/// A moving body and a static one, each by its row among its kind.
struct StaticPair {
    std::uint32_t a, fixed;
};

/// Half extents of moving bodies that all have one size.
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

/// Compares all pairs of bodies in each cell of a partition.
template <class Real>
class CellWalk {
  public:
    /// Finds every pair of the cells from `first` to `last` whose boxes overlap when `inflation`,
    /// and what the partition has extra, is added to the sums of their half extents; from a
    /// complete partition, each pair once. Moving bodies come as `onMoving(a, others, hits)`: body
    /// `a` overlaps others[l] for each set bit l of `hits`, which may be none. Pairs with static
    /// bodies come as `onStatic(StaticPair)`. Returns the number of pairs compared.
    template <class Sizes, class OnMoving, class OnStatic>
    std::uint64_t walk(const BodyView<Real>& bodies, const Partition<Real>& partition,
                       const Sizes& sizes, Real inflation, std::size_t first, std::size_t last,
                       OnMoving&& onMoving, OnStatic&& onStatic) {
        const auto& f = bodies.fixed;
        const Cells& cells = partition.cells;
        std::uint64_t tested = 0;
        for (std::size_t c = first; c < last; ++c) {
            const auto members = cells[c];
            if (members.size() < 2) continue;
            const std::size_t moving = movingAmong(members);
            if (moving == 0) continue;
            gather(bodies, sizes, partition, c, members.first(moving));
            for (std::size_t i = 0; i + 1 < moving; ++i) {
                const Box<Real> box = inflated({x_[i], y_[i], width_[i], height_[i]}, inflation);
                forEachBlock(box, crossedEdges(i), i + 1, moving,
                             [&](std::size_t start, Bits hits) {
                                 onMoving(members[i].row(), members.data() + start, hits);
                             });
            }
            for (std::size_t k = moving; k < members.size(); ++k) {
                const std::uint32_t row = members[k].row();
                const Box<Real> box =
                    inflated({f.x[row], f.y[row], f.halfWidth[row], f.halfHeight[row]}, inflation);
                forEachBlock(box, partition.crossedEdges(c, members[k]), 0, moving,
                             [&](std::size_t start, Bits hits) {
                                 forEachBit(hits, [&](std::size_t l) {
                                     onStatic(StaticPair{members[start + l].row(), row});
                                 });
                             });
            }
            tested += moving * (moving - 1) / 2 + moving * (members.size() - moving);
        }
        return tested;
    }

    std::size_t bytes() const {
        return (x_.capacity() + y_.capacity() + width_.capacity() + height_.capacity()) *
                   sizeof(Real) +
               (left_.capacity() + below_.capacity()) * sizeof(Bits);
    }

  private:
    static constexpr std::size_t block = hitBlock<Real>;
    using Bits = HitBits<Real>;

    CrossedEdges crossedEdges(std::size_t i) const {
        return {(left_[i / block] >> i % block & 1) != 0,
                (below_[i / block] >> i % block & 1) != 0};
    }

    /// Calls `function(start, hits)` for each block of gathered boxes from `first` to `last`: bit l
    /// says that box start + l overlaps `box` and that their pair belongs to this cell.
    template <class Function>
    void forEachBlock(const Box<Real>& box, CrossedEdges edges, std::size_t first, std::size_t last,
                      Function&& function) const {
        for (std::size_t start = first / block * block; start < last; start += block) {
            const Real* const x = x_.data() + start;
            const Real* const y = y_.data() + start;
            const Real* const width = width_.data() + start;
            const Real* const height = height_.data() + start;
            Bits hits = hitBits<Real>([&](std::size_t l) {
                return overlap(box, Box<Real>{x[l], y[l], width[l], height[l]});
            });
            if (start < first) hits &= ~Bits(0) << (first - start);
            hits &= belongToCell(edges, left_[start / block], below_[start / block]);
            function(start, hits);
        }
    }

    /// Brings the boxes of a cell together, and fills up the last block with boxes that nothing
    /// overlaps.
    template <class Sizes>
    void gather(const BodyView<Real>& bodies, const Sizes& sizes, const Partition<Real>& partition,
                std::size_t cell, std::span<const BodyRef> members) {
        const std::size_t blocks = (members.size() + block - 1) / block;
        if (blocks > left_.size()) {
            for (auto* column : {&x_, &y_, &width_, &height_}) column->resize(2 * blocks * block);
            left_.resize(2 * blocks);
            below_.resize(2 * blocks);
        }
        const Real* const x = bodies.moving.x.data();
        const Real* const y = bodies.moving.y.data();
        std::size_t i = 0;
        for (std::size_t b = 0; b < blocks; ++b) {
            Bits left = 0;
            Bits below = 0;
            const std::size_t end = std::min(members.size(), (b + 1) * block);
            for (std::size_t l = 0; i < end; ++i, ++l) {
                const std::uint32_t row = members[i].row();
                x_[i] = x[row];
                y_[i] = y[row];
                width_[i] = sizes.width(row);
                height_[i] = sizes.height(row);
                const CrossedEdges edges = partition.crossedEdgesOfMoving(cell, row);
                left |= Bits(edges.left) << l;
                below |= Bits(edges.below) << l;
            }
            left_[b] = left;
            below_[b] = below;
        }
        if (!partition.extra.empty()) {
            for (std::size_t k = 0; k < members.size(); ++k) {
                width_[k] += partition.extra[members[k].row()];
                height_[k] += partition.extra[members[k].row()];
            }
        }
        for (; i < blocks * block; ++i) {
            x_[i] = std::numeric_limits<Real>::infinity();
            y_[i] = width_[i] = height_[i] = 0;
        }
    }

    // The cell that is being walked: boxes, and in a bit per box of each block, which edges of the
    // cell they cross.
    std::vector<Real> x_, y_, width_, height_;
    std::vector<Bits> left_, below_;
};

}  // namespace quadrille
