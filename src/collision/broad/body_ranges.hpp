#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <quadrille/bodies.hpp>
#include <quadrille/vec2.hpp>

#include "collision/broad/partitioner.hpp"
#include "collision/rules/fine_grid.hpp"

namespace quadrille {

/// `columns` by `rows` cells, whose low corner is `origin`; in px.
template <class Real>
FineGrid<Real> makeFineGrid(const Vec2& origin, const Vec2& cell, std::uint32_t columns,
                            std::uint32_t rows) {
    return {.lowX = static_cast<Real>(origin.x()),
            .lowY = static_cast<Real>(origin.y()),
            .perX = static_cast<Real>(1 / cell.x()),
            .perY = static_cast<Real>(1 / cell.y()),
            .lastX = static_cast<Real>(columns - 1),
            .lastY = static_cast<Real>(rows - 1)};
}

/// The cells that the inflated boxes of bodies begin..end touch, moving ones first, to their places
/// in the partition.
template <class Real>
void findRanges(Partition<Real>& partition, const BodyView<Real>& bodies, std::size_t begin,
                std::size_t end) {
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    const FineGrid<Real>& grid = partition.grid;
    const Real margin = partition.margin;
    FineRange* const out = partition.ranges.data();
    const std::size_t moving = m.size();
    const std::size_t last = std::min(end, moving);
    if (!partition.extra.empty()) {
        for (std::size_t i = begin; i < last; ++i) {
            const Real own = margin + partition.extra[i];
            out[i] = grid.range(m.x[i], m.y[i], m.halfWidth[i] + own, m.halfHeight[i] + own);
        }
    } else if (m.halfWidth.uniform() && m.halfHeight.uniform()) {
        const Real halfWidth = m.halfWidth.common + margin;
        const Real halfHeight = m.halfHeight.common + margin;
        for (std::size_t i = begin; i < last; ++i) {
            out[i] = grid.range(m.x[i], m.y[i], halfWidth, halfHeight);
        }
    } else {
        for (std::size_t i = begin; i < last; ++i) {
            out[i] = grid.range(m.x[i], m.y[i], m.halfWidth[i] + margin, m.halfHeight[i] + margin);
        }
    }
    for (std::size_t k = std::max(begin, moving) - moving; k + moving < end; ++k) {
        out[moving + k] =
            grid.range(f.x[k], f.y[k], f.halfWidth[k] + margin, f.halfHeight[k] + margin);
    }
}

}  // namespace quadrille
