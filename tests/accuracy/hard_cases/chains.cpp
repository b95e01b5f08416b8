// Collisions along a line: cradle, unequal masses.

#include <algorithm>
#include <cmath>
#include <utility>

#include "hard_cases/hard_case.hpp"

namespace quadrille::accuracy {

namespace {

/// `incoming` squares run into a row of six that touch: as many leave on the far side.
Outcome cradle(const Setup& setup, std::size_t incoming) {
    constexpr double speed = 6;
    std::vector<Body> bodies;
    for (std::size_t i = 0; i < incoming; ++i) {
        bodies.push_back({{-10.0 - static_cast<double>(i), 0}, {speed, 0}});
    }
    for (int i = 0; i < 6; ++i) bodies.push_back({{1.0 * i, 0}});
    Simulation sim = simulate(setup, bodies);
    const double energy = kineticEnergy(sim.world());
    constexpr double duration = 5;  // s; the first hit is after 9 px
    sim.run(static_cast<std::uint64_t>(60 * duration));

    std::vector<std::pair<double, double>> row;  // position, velocity
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        row.emplace_back(position(sim, i).x(), velocity(sim, i).x());
    }
    std::sort(row.begin(), row.end());
    bool exact = true;
    int forward = 0;
    double off = 0;
    std::vector<double> figures;
    for (std::size_t i = 0; i < row.size(); ++i) {
        const auto [x, v] = row[i];
        const bool leaves = i + incoming >= row.size();
        const double stop = static_cast<double>(i) - static_cast<double>(incoming);
        off = std::max(off, std::abs(x - stop - (leaves ? speed * duration - 9 : 0)));
        exact = exact && v == (leaves ? speed : 0);
        forward += v > 1e-3 * speed ? 1 : 0;
        figures.insert(figures.end(), {x, v});
    }
    std::string text = std::to_string(forward) + " leave";
    const double gain = kineticEnergy(sim.world()) / energy - 1;
    if (std::abs(gain) > 1e-3) text += ", energy " + percent(gain);
    if (exact) text = "right speeds, " + number(off, 2) + " px off";
    return exactIf(exact && off <= setup.rounding(1e-12, 2e-5), text, listing(figures));
}

/// The largest deviation from the expected velocities along x.
Outcome velocitiesAlongX(const Simulation& sim, const std::vector<double>& expected,
                         double tolerance) {
    double worst = 0;
    std::vector<double> speeds;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        speeds.push_back(velocity(sim, i).x());
        worst = std::max(worst, std::abs(speeds[i] - expected[i]));
    }
    return exactIf(worst <= tolerance, "speeds off by " + number(worst, 2), listing(speeds));
}

Outcome massesInARow(const Setup& setup) {
    Simulation sim = simulate(setup, {{{0, 0}, {1, 0}, {1, 1}, 1},
                                      {{2, 0}, {0, 0}, {1, 1}, 2},
                                      {{4, 0}, {0, 0}, {1, 1}, 4},
                                      {{6, 0}, {0, 0}, {1, 1}, 8}});
    sim.run(60 * 20);
    return velocitiesAlongX(sim, {-1.0 / 3, -2.0 / 9, -4.0 / 27, 8.0 / 27},
                            setup.rounding(1e-15, 1e-7));
}

Outcome massRatioOfAMillion(const Setup& setup) {
    Simulation sim = simulate(setup, {{{-5, 0}, {3, 0}}, {{5, 0}, {-2, 0}, {1, 1}, 1e-6}});
    sim.run(60 * 3);
    // 3 - 2e-6 * 5 / (1 + 1e-6) and its partner.
    return velocitiesAlongX(sim, {2.99999000001, 7.99999000001}, setup.rounding(1e-11, 1e-6));
}

}  // namespace

std::vector<HardCase> chainCases() {
    struct Row {
        std::size_t incoming;
        Texts baseline, impulse;
    };
    const Row rows[] = {
        {1, "0 leave, energy -100 %", {"right speeds, 0.50 px off", "right speeds, 0.40 px off"}},
        {2, "0 leave, energy -100 %", {"right speeds, 0.50 px off", "right speeds, 0.41 px off"}},
        {3, "2 leave, energy -33 %", {"right speeds, 0.50 px off", "right speeds, 0.42 px off"}},
        {4, "3 leave, energy -25 %", {"right speeds, 0.50 px off", "right speeds, 0.43 px off"}},
        {5, "4 leave, energy -20 %", {"right speeds, 0.50 px off", "right speeds, 0.46 px off"}}};
    std::vector<HardCase> cases;
    for (const Row& row : rows) {
        const std::size_t k = row.incoming;
        cases.push_back({"Cradle" + std::to_string(k),
                         "cradle of 6 touching squares, " + std::to_string(k) + " in",
                         [k](const Setup& setup) { return cradle(setup, k); }, row.baseline,
                         row.impulse, "exact"});
    }
    cases.push_back(
        {"MassesInARow", "masses 1, 2, 4, 8 in a row", massesInARow, "exact", "exact", "exact"});
    cases.push_back({"MassRatioOfAMillion", "head-on, mass ratio 1e-6", massRatioOfAMillion,
                     "exact", "exact", "exact"});
    return cases;
}

}  // namespace quadrille::accuracy
