#pragma once

#include <cstddef>
#include <cstdint>

#include <quadrille/detail/host_device.hpp>

#include "collision/rules/fine_grid.hpp"
#include "collision/rules/pair_geometry.hpp"

namespace quadrille {

/// Which static boxes lie in a region, for host and device alike: a grid whose cells name
/// the boxes that touch them. There is at least one box.
template <class Real>
struct StaticMapView {
    const Box<Real>* boxes;
    const std::uint32_t* offsets;  ///< of a cell into `members`, and one more
    const std::uint32_t* members;  ///< boxes
    const std::uint8_t* crowded;   ///< of a cell: a box lies within the clearance of it
    FineGrid<Real> grid;
    std::size_t side;  ///< cells along each axis
    Real clearance;    ///< px

    /// Whether there is surely nothing within `roomX` and `roomY` of the point.
    QUADRILLE_HD bool clear(Real x, Real y, Real roomX, Real roomY) const {
        return roomX <= clearance && roomY <= clearance && !crowded[cellAt(x, y)];
    }

    /// Calls `function(box)` for the boxes that overlap the region, for some more than once.
    template <class Function>
    QUADRILLE_HD void forEachIn(const Box<Real>& region, Function&& function) const {
        const FineRange r = grid.range(region.x, region.y, region.halfWidth, region.halfHeight);
        for (std::uint32_t y = r.y0; y <= r.y1; ++y) {
            for (std::uint32_t x = r.x0; x <= r.x1; ++x) {
                const std::size_t cell = y * side + x;
                for (std::uint32_t i = offsets[cell]; i < offsets[cell + 1]; ++i) {
                    const Box<Real>& box = boxes[members[i]];
                    if (overlap(region, box)) function(box);
                }
            }
        }
    }

    QUADRILLE_HD std::size_t cellAt(Real x, Real y) const {
        const std::size_t row = FineGrid<Real>::coordinate(y, grid.lowY, grid.perY, grid.lastY);
        return row * side + FineGrid<Real>::coordinate(x, grid.lowX, grid.perX, grid.lastX);
    }
};

}  // namespace quadrille
