#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <quadrille/body_ref.hpp>
#include <quadrille/cell_coordinates.hpp>
#include <quadrille/vec2.hpp>

namespace quadrille {

/// A rectangle in px.
struct Bounds {
    Vec2 low{0, 0}, high{0, 0};
};

/// Cells in compressed sparse rows: cell c holds bodies[offsets[c] .. offsets[c + 1]), in ascending
/// order: moving bodies by row, static ones after them. A body stands in every cell that its box
/// touches. Cells are half-open and those on the border reach to infinity, so each point of
/// the plane lies in exactly one.
struct Cells {
    std::vector<std::uint32_t> offsets{0};
    std::vector<BodyRef> bodies;
    std::vector<CellCoordinates> coordinates;  ///< one a cell

    Vec2 origin{0, 0};    ///< low corner of fine cell (0, 0), px
    Vec2 fineCell{0, 0};  ///< size of a fine cell, px

    std::size_t size() const { return offsets.size() - 1; }
    std::span<const BodyRef> operator[](std::size_t cell) const {
        return {bodies.data() + offsets[cell], bodies.data() + offsets[cell + 1]};
    }
    /// The finite rectangle of a cell; for border cells, the part of it inside the world.
    Bounds bounds(std::size_t cell) const;
};

/// How the bodies are spread over the cells.
struct CellLoad {
    std::size_t cells = 0;
    std::size_t activeCells = 0;  ///< that hold a body
    std::size_t maxBodies = 0;    ///< in one cell
    double meanBodies = 0;        ///< over the active cells
};

CellLoad loadOf(const Cells& cells);

}  // namespace quadrille
