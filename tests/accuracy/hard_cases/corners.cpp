// Ties of the axes and of time.

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

/// Columns of squares that fall onto a floor at speeds of their own and touch each other and the
/// floor at one instant, which no double holds, so that rounding orders the hits. Each
/// leaves as fast as it came.
Outcome columnsOntoAFloor(const Setup& setup) {
    constexpr int height = 6;
    constexpr double side = 3;
    constexpr double instant = 28.0 / 39;  // s
    int through = 0;
    int wrong = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        std::vector<Body> bodies;
        std::vector<double> speeds;
        for (int i = 0; i < height; ++i) {
            // From the floor up, each is faster than the one below, which it reaches at the
            // instant.
            speeds.push_back((i == 0 ? 0 : speeds.back()) +
                             static_cast<double>(random.integer(1, 5)));
            const double y = side * (i + 0.5) + speeds.back() * instant;
            bodies.push_back({{0, y}, {0, -speeds.back()}, {side, side}});
        }
        bodies.push_back({{0, -10}, {0, 0}, {100, 20}, 1, true});
        Simulation sim = simulate(setup, bodies);
        sim.run(180);
        bool left = false;
        bool same = true;
        for (std::size_t i = 0; i < height; ++i) {
            left = left || position(sim, i).y() < side / 2 - 1e-3;
            same = same && velocity(sim, i).y() == speeds[i];
        }
        through += left ? 1 : 0;
        wrong += same ? 0 : 1;
    }
    const std::string detail =
        std::to_string(through) + " through, " + std::to_string(wrong) + " with other speeds";
    if (through > 0) return {"through the floor in " + std::to_string(through) + " of 200", detail};
    return exactIf(wrong == 0, "other speeds in " + std::to_string(wrong) + " of 200", detail);
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
             "exact"},
            {"ColumnsOntoAFloor", "columns of 6 onto a floor, all at one instant",
             columnsOntoAFloor, "other speeds in 200 of 200", "exact", "exact"}};
}

}  // namespace quadrille::accuracy
