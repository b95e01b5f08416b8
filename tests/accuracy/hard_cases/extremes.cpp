// Fast, thin, far, small and large.

#include <cmath>

#include "hard_cases/hard_case.hpp"

namespace quadrille::accuracy {

namespace {

/// The time of the first collision against the exact one, s.
Outcome timeOfImpact(const std::vector<Contact>& hits, double exact, double tolerance) {
    if (hits.empty()) return {"tunnels", "no collision"};
    const double late = hits[0].time - exact;
    const std::string detail =
        listing({hits[0].time, late}) + ", " + std::to_string(hits.size()) + " collisions";
    if (hits.size() > 1) return {std::to_string(hits.size()) + " hits", detail};
    return exactIf(std::abs(late) <= tolerance,
                   number(1000 * std::abs(late), 2) + (late > 0 ? " ms late" : " ms early"),
                   detail);
}

Outcome bullet(const Setup& setup) {
    Simulation sim = simulate(setup, {{{-50, 0}, {6000, 0}}, {{0, 0}, {0, 0}, {0.1, 50}, 1, true}});
    const ContactLog log(sim);
    sim.run(2);
    return timeOfImpact(log.collisions(), 989.0 / 120000, setup.rounding(1e-17, 1e-8));
}

Outcome farFromTheOrigin(const Setup& setup, double far) {
    Simulation sim = simulate(setup, {{{far, far}, {5, 5}}});
    sim.run(600);
    const Vec2 moved = position(sim, 0) - Vec2(far, far);
    // What the precision can hold of far + 50.
    const double there = setup.isDouble() ? far + 50 : static_cast<float>(far + 50);
    return exactIf(moved == Vec2(there - far, there - far),
                   std::abs(moved.x() - 50) < 1e-3 ? "within " + belowPower(moved.x() - 50) + " px"
                                                   : number(moved.x()) + " px",
                   listing({moved.x(), moved.y()}));
}

Outcome tinyMeetsHuge(const Setup& setup) {
    Simulation sim =
        simulate(setup, {{{-2000.0625, 0}, {10, 0}, {1e-3, 1e-3}}, {{0, 0}, {0, 0}, {1e3, 1e3}}});
    const ContactLog log(sim);
    sim.run(60 * 160);
    return timeOfImpact(log.collisions(), (2000.0625 - 500 - 0.0005) / 10,
                        setup.rounding(1e-9, 1e-6));
}

}  // namespace

std::vector<HardCase> extremeCases() {
    return {{"Bullet", "1 px at 6000 px/s, wall of 0.1 px", bullet, "tunnels", "tunnels", "exact"},
            {"FarMillion",
             "1e6 px from the origin, 50 px on",
             [](const Setup& s) { return farFromTheOrigin(s, 1e6); },
             {"within 1e-7 px", "37.5 px"},
             {"within 1e-7 px", "37.5 px"},
             "exact"},
            {"FarBillion",
             "1e9 px from the origin, 50 px on",
             [](const Setup& s) { return farFromTheOrigin(s, 1e9); },
             {"within 1e-4 px", "0 px"},
             {"within 1e-4 px", "0 px"},
             "exact"},
            {"TinyMeetsHuge",
             "sides 1e-3 and 1e3, time of impact",
             tinyMeetsHuge,
             {"10 ms late", "27 ms late"},
             {"exact", "18 ms late"},
             "exact"}};
}

}  // namespace quadrille::accuracy
