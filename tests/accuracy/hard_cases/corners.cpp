// Ties of the axes and of time.

#include <array>

#include "hard_cases/hard_case.hpp"

namespace quadrille::accuracy {

namespace {

Outcome cornerToCorner(const Setup& setup) {
    Simulation sim = simulate(setup, {{{-5, -5}, {1, 1}}, {{5, 5}, {-1, -1}}});
    sim.run(600);
    const Vec2 a = velocity(sim, 0);
    const Vec2 b = velocity(sim, 1);
    const bool x = a.x() == -1 && b.x() == 1;
    const bool y = a.y() == -1 && b.y() == 1;
    return exactIf(x && y, x != y ? "one axis reverses" : "passes",
                   listing({a.x(), a.y(), b.x(), b.y()}));
}

Outcome levelEdges(const Setup& setup) {
    Simulation sim = simulate(setup, {{{-5, 0}, {1, 0}}, {{5, 1}, {-1, 0}}});
    std::size_t contacts = 0;
    sim.onContact([&](const Contact&) { ++contacts; });
    sim.run(900);
    return exactIf(contacts == 0 && velocity(sim, 0) == Vec2(1, 0), "collide");
}

Outcome fourOntoAFifth(const Setup& setup) {
    // Smaller than the fifth: squares of its size would meet each other at its corners as well.
    const Vec2 small(0.5, 0.5);
    const std::vector<Body> bodies{{{0, 0}},
                                   {{-5, 0}, {1, 0}, small},
                                   {{5, 0}, {-1, 0}, small},
                                   {{0, -5}, {0, 1}, small},
                                   {{0, 5}, {0, -1}, small}};
    Simulation sim = simulate(setup, bodies);
    sim.run(600);
    std::string detail;
    int back = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Vec2 v = velocity(sim, i);
        detail += listing({v.x(), v.y()}) + "; ";
        if (i > 0) back += v == -bodies[i].velocity ? 1 : 0;
    }
    const Vec2 centre = position(sim, 0);
    detail += listing({centre.x(), centre.y()});
    if (velocity(sim, 0) != Vec2(0, 0)) return {"the fifth moves", detail};
    if (back < 4) return {std::to_string(back) + " of 4 come back", detail};
    return exactIf(centre == Vec2(0, 0),
                   "the fifth rests " + number(centre.norm(), 2) + " px aside", detail);
}

}  // namespace

std::vector<HardCase> cornerCases() {
    return {{"CornerToCorner", "corner to corner", cornerToCorner, "one axis reverses", "exact",
             "exact"},
            {"LevelEdges", "passing with the edges level", levelEdges, "exact", "exact", "exact"},
            {"FourOntoAFifth",
             "four squares onto a fifth",
             fourOntoAFifth,
             "1 of 4 come back",
             {"the fifth rests 0.024 px aside", "the fifth rests 0.012 px aside"},
             "exact"}};
}

}  // namespace quadrille::accuracy
