// Bounces, rest and stacks under gravity.

#include <algorithm>
#include <cmath>

#include <quadrille/state_hash.hpp>

#include "hard_cases/hard_case.hpp"

namespace quadrille::accuracy {

namespace {

constexpr double g = 200;  // px/s^2
const Body ground{{0, -10}, {0, 0}, {200, 20}, 1, true};

Conditions falling(double restitution) {
    return {.step = {.gravity = {0, -g}, .restitution = restitution}};
}

/// An elastic box falls from `height` for a minute: its energy stays, and the time between bounces
/// is 2 sqrt(2 height / g). Ten heights, the worst of each figure.
Outcome bounce(const Setup& setup) {
    double swing = 0;  // of the energy, relative
    double lost = 0;   // of the height, at the end
    double late = 0;   // of the period, relative
    for (int i = 0; i < 10; ++i) {
        const double height = 50 + 10.5 * i;
        Simulation sim = simulate(setup, {{{0, 1 + height}, {0, 0}, {2, 2}}, ground}, falling(1));
        const ContactLog log(sim);
        double top = 0;  // of the last ten seconds
        for (int step = 0; step < 60 * 60; ++step) {
            sim.step();
            const double v = velocity(sim, 0).y();
            const double y = position(sim, 0).y() - 1;
            swing = std::max(swing, std::abs((v * v / 2 + g * y) / (g * height) - 1));
            if (step >= 50 * 60) top = std::max(top, y);
        }
        lost = std::max(lost, 1 - top / height);
        const auto& hits = log.collisions();
        if (hits.size() < 2) return {"does not bounce", {}};
        const double period =
            (hits.back().time - hits.front().time) / static_cast<double>(hits.size() - 1);
        late = std::max(late, std::abs(period / (2 * std::sqrt(2 * height / g)) - 1));
    }
    const double rounding = setup.rounding(1e-9, 1e-5);
    std::string text = lost > 0.05 ? "loses up to " + number(100 * lost, 2) + " % of its height"
                                   : "energy swings by " + number(100 * swing, 2) + " %";
    if (lost <= 0.05 && late > 1e-3) text += ", period off by " + number(100 * late, 2) + " %";
    return exactIf(swing <= rounding && late <= rounding, text, listing({swing, lost, late}));
}

/// A column of boxes that touch, at rest: nothing happens, whatever the restitution.
Outcome atRest(const Setup& setup, std::size_t count) {
    double sinks = 0;  // px
    double rises = 0;  // px
    double speed = 0;  // px/s
    for (const double restitution : {0.0, 0.5, 1.0}) {
        std::vector<Body> bodies;
        for (std::size_t i = 0; i < count; ++i) {
            bodies.push_back({{0, 4 + 8 * static_cast<double>(i)}, {0, 0}, {8, 8}});
        }
        bodies.push_back(ground);
        Simulation sim = simulate(setup, bodies, falling(restitution));
        for (int step = 0; step < 60 * 20; ++step) {
            sim.step();
            for (std::size_t i = 0; i < count; ++i) {
                const double moved = position(sim, i).y() - bodies[i].position.y();
                sinks = std::max(sinks, -moved);
                rises = std::max(rises, moved);
                speed = std::max(speed, velocity(sim, i).norm());
            }
        }
    }
    const std::string detail = listing({sinks, rises, speed});
    const double rounding = setup.rounding(1e-12, 1e-4);
    if (sinks == 0 && rises == 0 && speed == 0) return {"exact", detail};
    if (std::max(sinks, rises) > rounding) {
        return {rises > sinks ? "thrown up " + number(rises, 2) + " px"
                              : "sinks " + number(sinks, 2) + " px",
                detail};
    }
    return {speed > rounding ? "stays, with a speed of " + number(speed, 2) + " px/s"
                             : "stays within rounding",
            detail};
}

/// Each bounce has half the speed of the one before, so all of them are over after a finite time.
Outcome comesToRest(const Setup& setup) {
    constexpr double height = 90;
    constexpr double e = 0.5;
    Simulation sim = simulate(setup, {{{0, 1 + height}, {0, 0}, {2, 2}}, ground}, falling(e));
    const ContactLog log(sim);
    const double fall = std::sqrt(2 * height / g);
    const double rest = fall * (1 + e) / (1 - e);
    sim.run(static_cast<std::uint64_t>(60 * (rest + 1)));
    const std::uint64_t then = stateHash(sim.world());
    const std::size_t bounces = log.collisions().size();
    sim.run(60);

    double late = 0;  // of the first eight bounces, s
    double exact = fall;
    double flight = 2 * fall;
    for (std::size_t i = 0; i < 8; ++i) {
        if (i >= bounces) return {std::to_string(bounces) + " bounces", {}};
        late = std::max(late, std::abs(log.collisions()[i].time - exact));
        flight *= e;
        exact += flight;
    }
    const double gap = std::abs(position(sim, 0).y() - 1);
    const double speed = velocity(sim, 0).norm();
    const bool still = stateHash(sim.world()) == then && speed == 0;
    const double rounding = setup.rounding(1e-9, 1e-4);
    const std::string text = gap > rounding ? number(gap, 2) + " px off"
                             : speed > rounding
                                 ? "rests, with a speed of " + number(speed, 2) + " px/s"
                                 : "rests";
    return exactIf(
        still && gap <= rounding && late <= rounding,
        text + (late > rounding ? ", bounces " + number(1000 * late, 2) + " ms off" : ""),
        listing({gap, speed, late, static_cast<double>(bounces), still ? 1.0 : 0.0}));
}

}  // namespace

std::vector<HardCase> gravityCases() {
    return {
        {"Bounce",
         "bounce under gravity, 60 s",
         bounce,
         {"loses up to 83 % of its height", "loses up to 87 % of its height"},
         "energy swings by 2.4 %",
         "exact"},
        {"BoxAtRest", "box at rest under gravity, 20 s",
         [](const Setup& s) { return atRest(s, 1); }, "stays, with a speed of 3.3 px/s", "exact",
         "exact"},
        {"StackAtRest", "stack of 5 boxes at rest, 20 s",
         [](const Setup& s) { return atRest(s, 5); }, "thrown up 96 px", "sinks 12 px", "exact"},
        {"ComesToRest",
         "bounce with restitution 1/2 to rest",
         comesToRest,
         {"rests, with a speed of 1.1 px/s, bounces 83 ms off",
          "rests, with a speed of 1.1 px/s, bounces 116 ms off"},
         "rests, bounces 9.4 ms off",
         "exact"}};
}

}  // namespace quadrille::accuracy
