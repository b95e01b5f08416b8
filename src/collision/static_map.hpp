#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <quadrille/bodies.hpp>

#include "collision/rules/fine_grid.hpp"
#include "collision/rules/pair_geometry.hpp"
#include "collision/rules/static_map_view.hpp"

namespace quadrille {

/// Which static boxes lie in a region: a grid over all of them, made anew only when one has
/// changed. It belongs to no partition, because contacts move bodies further than its cells cover.
template <class Real>
class StaticMap {
  public:
    /// Makes the map that of these static boxes; called after an edit. Returns whether it is
    /// another one now.
    bool update(const BodyView<Real>& bodies);

    bool empty() const { return boxes_.empty(); }
    std::size_t size() const { return boxes_.size(); }

    /// For the rules, until the next call of `update`; of a map that is not empty.
    StaticMapView<Real> view() const {
        return {.boxes = boxes_.data(),
                .offsets = offsets_.data(),
                .members = members_.data(),
                .crowded = crowded_.data(),
                .grid = grid_,
                .side = side_,
                .clearance = clearance_};
    }

    std::size_t bytes() const;

  private:
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
