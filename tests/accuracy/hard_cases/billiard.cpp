// Galperin's billiard ("Playing pool with pi", 2003): accuracy.md, section 4.

#include <algorithm>
#include <cmath>
#include <limits>

#include "hard_cases/hard_case.hpp"

namespace quadrille::accuracy {

namespace {

constexpr int digitsOfPi[] = {3, 31, 314, 3141, 31415, 314159};

Outcome billiard(const Setup& setup, int k) {
    const double root = std::pow(10.0, k);  // of the ratio of masses
    // Gaps that no whole number of steps covers.
    Simulation sim = simulate(setup, {{{1.0625 + 0.5, 0}, {0, 0}, {1, 1}},
                                      {{3.09375 + 1.5, 0}, {-1, 0}, {1, 1}, root * root},
                                      {{-5, 0}, {0, 0}, {10, 10}, 1, true}});
    std::size_t hits = 0;
    sim.onContact([&](const Contact& c) { hits += c.collided ? 1 : 0; });
    // x, the light block's gap to the wall, and X, what it leaves to the heavy block.
    const auto gaps = [&] { return Vec2(position(sim, 0).x() - 0.5, position(sim, 1).x() - 1.5); };
    // Twice the area that the line of motion sweeps about the tip of the unfolded wedge.
    const auto area = [&] {
        const Vec2 at = gaps();
        return std::abs(at.y() * velocity(sim, 0).x() - at.x() * velocity(sim, 1).x());
    };
    const double start = area();
    double least = std::numeric_limits<double>::max();
    double drift = 0;
    for (int i = 0; i < 60 * 12; ++i) {
        sim.step();
        least = std::min(least, gaps().x());
        drift = std::max(drift, std::abs(area() - start));
    }
    const double n = std::ceil(digitsOfPi[k] / 2.0);
    const double angle = 2 * n * std::atan(1 / root);
    const double heavyOff = std::abs(velocity(sim, 1).x() + std::cos(angle));
    const double lightOff =
        std::abs(std::abs(velocity(sim, 0).x()) / root - std::abs(std::sin(angle)));
    const std::string detail =
        std::to_string(hits) + " hits, " + listing({heavyOff, lightOff, least, drift});
    // Speeds reach root, and so does what rounding makes of the product of place and speed.
    const double rounding = setup.rounding(1e-11, 1e-4);
    const bool counts = hits == static_cast<std::size_t>(digitsOfPi[k]);
    std::string text = std::to_string(hits) + " hits";
    if (least < -1e-3) {
        text += ", " + number(-least, 2) + " px into the wall";
    } else if (counts) {
        text += ", X v - x V off by " + number(100 * drift / start, 2) + " %";
    }
    return exactIf(counts && heavyOff <= rounding && lightOff <= rounding && least >= -rounding &&
                       drift <= rounding * root,
                   text, detail);
}

}  // namespace

std::vector<HardCase> billiardCases() {
    struct Row {
        Texts baseline, impulse;
    };
    const Row rows[] = {{"3 hits, X v - x V off by 0.15 %", "exact"},
                        {"31 hits, X v - x V off by 50 %", "31 hits, X v - x V off by 5.9 %"},
                        {"106 hits", "27 hits"},
                        {"102 hits", "27 hits"},
                        {"102 hits", "27 hits"},
                        {"102 hits", "27 hits"}};
    std::vector<HardCase> cases;
    for (int k = 0; k <= 5; ++k) {
        cases.push_back({"Billiard" + std::to_string(k),
                         "Galperin's billiard, " + std::to_string(digitsOfPi[k]) + " hits",
                         [k](const Setup& setup) { return billiard(setup, k); }, rows[k].baseline,
                         rows[k].impulse, "exact"});
    }
    return cases;
}

}  // namespace quadrille::accuracy
