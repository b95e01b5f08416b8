#pragma once

#include <cstdint>

#include <quadrille/cell_coordinates.hpp>
#include <quadrille/detail/host_device.hpp>

/// To which cell a pair belongs, for host and device alike.

namespace quadrille {

/// The fine cells that a box touches: x0..x1 by y0..y1, both ends included.
struct FineRange {
    std::uint16_t x0, y0, x1, y1;
};

/// Whether a body's box begins left of a cell or below it.
///
/// Of the cells that two bodies share, their pair belongs to the one that holds the low corner of
/// the intersection of their boxes: the one in which no edge is crossed by both. Pairs of an
/// incomplete partition belong to every cell that they share.
struct CrossedEdges {
    bool left, below;
};

QUADRILLE_HD inline CrossedEdges crossedEdgesOf(const CellCoordinates& cell,
                                                const FineRange& range) {
    return {range.x0 < cell.x, range.y0 < cell.y};
}

/// Whether a pair belongs to the cell, for many pairs at once: bit l of the result is about a body
/// with these edges and another one, whose edges are bit l of `left` and `below`.
template <class Bits>
QUADRILLE_HD inline Bits belongToCell(CrossedEdges edges, Bits left, Bits below) {
    return ~(left & (Bits(0) - Bits(edges.left))) & ~(below & (Bits(0) - Bits(edges.below)));
}

/// The same for one pair.
QUADRILLE_HD inline bool belongsToCell(CrossedEdges p, CrossedEdges q) {
    return (belongToCell<unsigned>(p, q.left, q.below) & 1u) != 0;
}

}  // namespace quadrille
