#pragma once

#include <string>
#include <variant>

#include <quadrille/vec2.hpp>

namespace quadrille {

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

}  // namespace quadrille
