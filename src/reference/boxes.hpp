#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "reference/oracle.hpp"

namespace quadrille::reference {

/// Throws std::invalid_argument, naming the box, if a value is impossible.
inline void validate(const std::vector<Box>& boxes) {
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        const Box& box = boxes[k];
        const auto refuse = [&](const char* what) {
            throw std::invalid_argument("box " + std::to_string(k) + ": " + what);
        };
        if (!box.position.allFinite()) refuse("position is not finite");
        if (!box.size.allFinite() || !(box.size.minCoeff() > 0)) refuse("size is not positive");
        if (box.isStatic) continue;
        if (!box.velocity.allFinite()) refuse("velocity is not finite");
        if (!std::isfinite(box.mass) || !(box.mass > 0)) refuse("mass is not positive");
    }
}

/// A good width of cells, px: wider than any moving box, with room for rounding, and not so small
/// that boxes which are far from each other cross many.
inline double cellWidth(const std::vector<Box>& boxes) {
    double side = 0;
    double count = 0;
    Vec2 low(0, 0);
    Vec2 high(0, 0);
    for (const Box& box : boxes) {
        if (box.isStatic) continue;
        side = std::max(side, box.size.maxCoeff());
        low = count == 0 ? box.position : Vec2(low.cwiseMin(box.position));
        high = count == 0 ? box.position : Vec2(high.cwiseMax(box.position));
        ++count;
    }
    if (count == 0) return 1;
    const Vec2 extent = high - low;
    return std::max(1.01 * side, 0.5 * std::sqrt(extent.x() / count * extent.y()));
}

}  // namespace quadrille::reference
