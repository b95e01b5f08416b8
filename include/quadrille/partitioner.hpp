#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <quadrille/cell_coordinates.hpp>
#include <quadrille/vec2.hpp>

namespace quadrille {

// ---- which partitioner to use, with its parameters

/// One cell that holds every body: the oracle of the others.
struct BruteForce {};

/// Equal cells over the world.
struct StaticGrid {
    Vec2 cellSize{26, 26};  ///< px
};

/// A tree, built anew each step: a leaf that holds more than `maxPerCell` bodies splits in four,
/// down to `maxDepth`.
struct Quadtree {
    int maxDepth = 10;  ///< 0 to 15
    int maxPerCell = 20;
};

/// The same tree, kept for several steps.
struct SemiStaticQuadtree {
    /// Boxes are inflated by a skin, and the tree is rebuilt before a body can have left its
    /// inflated box, so that no pair is missed.
    struct Skin {
        double width = 0;  ///< px on every side; 0 lets the tree choose from speeds and crowding
    };
    /// The report's policy: rebuild every so many steps, without a skin; misses pairs.
    struct EveryFrames {
        int frames = 10;
    };

    int maxDepth = 10;  ///< 0 to 15
    int maxPerCell = 20;
    std::variant<Skin, EveryFrames> rebuild = Skin{};
};

using PartitionerConfig = std::variant<BruteForce, StaticGrid, Quadtree, SemiStaticQuadtree>;

/// The name on the command line: "brute-force", "static-grid", "quadtree", "semi-static-quadtree".
std::string name(const PartitionerConfig& config);

// ---- what a partitioner puts out

/// A rectangle in px.
struct Bounds {
    Vec2 low{0, 0}, high{0, 0};
};

/// Cells in compressed sparse rows: cell c holds bodies[offsets[c] .. offsets[c + 1]), moving
/// bodies by row and static ones after them as movingCount + row. A body stands in every cell that
/// its box touches. Cells are half-open and those on the border reach to infinity, so each point of
/// the plane lies in exactly one.
struct Cells {
    std::vector<std::uint32_t> offsets{0};
    std::vector<std::uint32_t> bodies;
    std::vector<CellCoordinates> coordinates;  ///< one a cell

    Vec2 origin{0, 0};    ///< low corner of fine cell (0, 0), px
    Vec2 fineCell{0, 0};  ///< size of a fine cell, px

    std::size_t size() const { return offsets.size() - 1; }
    std::span<const std::uint32_t> operator[](std::size_t cell) const {
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

CellLoad load(const Cells& cells);

}  // namespace quadrille
