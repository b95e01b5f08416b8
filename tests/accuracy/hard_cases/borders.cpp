// Bodies exactly on the borders of cells.

#include <cmath>
#include <map>
#include <utility>

#include "hard_cases/hard_case.hpp"

namespace quadrille::accuracy {

namespace {

/// In every corner of four cells two squares meet, along x or along y, at a border.
std::vector<Body> meetingsOnBorders(const Vec2& world, int columns, int rows) {
    std::vector<Body> bodies;
    for (int column = 1; column < columns; ++column) {
        for (int row = 1; row < rows; ++row) {
            const Vec2 corner(world.x() * column / columns - world.x() / 2,
                              world.y() * row / rows - world.y() / 2);
            const Vec2 axis = (column + row) % 2 == 0 ? Vec2(1, 0) : Vec2(0, 1);
            bodies.push_back({corner - 2 * axis, 6 * axis, {2, 2}});
            bodies.push_back({corner + 2 * axis, -6 * axis, {2, 2}});
        }
    }
    return bodies;
}

Outcome onBorders(const Setup& setup) {
    struct Scene {
        Vec2 world;
        int columns, rows;
        PartitionerConfig partitioner;
    };
    using Skin = SemiStaticQuadtree::Skin;
    const Vec2 odd(100, 70);  // a seventh of the width is no double
    const Vec2 even(128, 128);
    const Scene scenes[] = {{{182, 130}, 7, 5, StaticGrid{}},
                            {odd, 7, 9, StaticGrid{{100.0 / 7, 70.0 / 9}}},
                            {even, 8, 8, Quadtree{3, 1}},
                            {even, 8, 8, Quadtree{10, 1}},
                            {odd, 8, 8, Quadtree{10, 1}},
                            {even, 8, 8, SemiStaticQuadtree{3, 1}},
                            {odd, 8, 8, SemiStaticQuadtree{10, 1, Skin{1}}},
                            {even, 8, 8, BruteForce{}}};
    for (const Scene& scene : scenes) {
        const auto bodies = meetingsOnBorders(scene.world, scene.columns, scene.rows);
        Simulation sim = simulate(setup, bodies, {.world = scene.world});
        sim.setPartitioner(scene.partitioner);
        std::map<std::pair<std::int64_t, std::int64_t>, int> hits;
        sim.onContact([&](const Contact& c) { ++hits[{c.numberA, c.numberB}]; });
        sim.run(20);
        const std::string detail =
            std::string(name(scene.partitioner)) + " " + number(scene.world.x());
        if (hits.size() != bodies.size() / 2) {
            return {
                "finds " + std::to_string(hits.size()) + " of " + std::to_string(bodies.size() / 2),
                detail};
        }
        for (const auto& [pair, count] : hits) {
            if (pair.second != pair.first + 1) return {"wrong pairs", detail};
            if (count != 1) return {"hits twice", detail};
        }
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (velocity(sim, i) != -bodies[i].velocity) return {"wrong speeds", detail};
        }
    }
    return {"exact", {}};
}

}  // namespace

std::vector<HardCase> borderCases() {
    return {{"OnBorders", "bodies on cell borders, every partitioner", onBorders, "exact", "exact",
             "exact"}};
}

}  // namespace quadrille::accuracy
