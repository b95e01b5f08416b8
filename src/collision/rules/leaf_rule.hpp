#pragma once

#include <cstddef>
#include <cstdint>

#include "collision/rules/cell_ownership.hpp"

/// When a node of the quadtree is a leaf, for every builder of one, on host and device alike. A
/// node is the square of fine cells [x, x + 2^shift) on each axis and the bodies that touch it.

namespace quadrille {

/// Whether a body covers a node entirely.
QUADRILLE_HD inline bool coversNode(const FineRange& range, std::uint32_t x, std::uint32_t y,
                                    int shift) {
    const std::uint32_t last = (1u << shift) - 1;
    return range.x0 <= x && range.x1 >= x + last && range.y0 <= y && range.y1 >= y + last;
}

/// A node is split until it is a single fine cell, or holds few enough bodies, or all its bodies
/// cover it: then no split could part them.
QUADRILLE_HD inline bool isLeaf(std::size_t count, std::size_t maxPerCell, int shift,
                                bool allCover) {
    return count <= maxPerCell || shift == 0 || allCover;
}

}  // namespace quadrille
