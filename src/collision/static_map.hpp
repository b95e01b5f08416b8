#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <quadrille/bodies.hpp>

#include "collision/rules/fine_grid.hpp"
#include "collision/rules/pair_geometry.hpp"

namespace quadrille {

/// Which static boxes lie in a region: a grid over all of them, made anew only when one has
/// changed. It belongs to no partition, because contacts move bodies further than its cells cover.
template <class Real>
class StaticMap {
  public:
    /// Makes the map that of these static boxes; called after an edit.
    void update(const BodyView<Real>& bodies);

    bool empty() const { return boxes_.empty(); }

    /// Whether there is surely nothing within `roomX` and `roomY` of the point.
    bool clear(Real x, Real y, Real roomX, Real roomY) const {
        return roomX <= clearance_ && roomY <= clearance_ && !crowded_[cellAt(x, y)];
    }

    /// Calls `function(box)` for the boxes that overlap the region, for some more than once.
    template <class Function>
    void forEachIn(const Box<Real>& region, Function&& function) const {
        const FineRange r = grid_.range(region.x, region.y, region.halfWidth, region.halfHeight);
        for (std::uint32_t y = r.y0; y <= r.y1; ++y) {
            for (std::uint32_t x = r.x0; x <= r.x1; ++x) {
                const std::size_t cell = y * side_ + x;
                for (std::uint32_t i = offsets_[cell]; i < offsets_[cell + 1]; ++i) {
                    const Box<Real>& box = boxes_[members_[i]];
                    if (overlap(region, box)) function(box);
                }
            }
        }
    }

    std::size_t bytes() const;

  private:
    std::size_t cellAt(Real x, Real y) const {
        const auto cell = [](Real position, Real low, Real per, Real last) {
            return std::size_t(FineGrid<Real>::coordinate(position, low, per, last));
        };
        return cell(y, grid_.lowY, grid_.perY, grid_.lastY) * side_ +
               cell(x, grid_.lowX, grid_.perX, grid_.lastX);
    }
    FineRange rangeOf(const Box<Real>& box, Real inflation) const {
        return grid_.range(box.x, box.y, box.halfWidth + inflation, box.halfHeight + inflation);
    }
    bool take(const BodyView<Real>& bodies);
    void makeGrid();
    std::size_t entries() const;
    void fill();
    template <class Function>
    void forEachCell(const FineRange& range, Function&& function) const;

    std::vector<Box<Real>> boxes_;
    FineGrid<Real> grid_;
    std::size_t side_ = 0;  // cells along each axis
    Real largest_ = 0;      // half extent of a moving body, px
    Real clearance_ = 0;    // px
    std::vector<std::uint32_t> offsets_, members_;
    std::vector<std::uint8_t> crowded_;  // of a cell: a box lies within the clearance of it
};

}  // namespace quadrille
