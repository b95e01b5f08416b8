#include "statistics/checks.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iomanip>
#include <iostream>
#include <utility>
#include <vector>

#include <quadrille/names.hpp>

namespace quadrille::accuracy {

namespace {

constexpr int blocks = 20;

/// Means over both axes.
struct Figures {
    Estimate rate;        ///< 1 + S K / N, from the hits of pairs
    Estimate pressure;    ///< F (Lx - S) / (N kT), from the hits on walls
    double identity = 0;  ///< what the wall identity is off by, relative to N kT
    double hits = 0;      ///< of pairs
    double overlap = 0;   ///< at the end, px
};

Figures measure(const GasConfig& config, const Sample& sample) {
    Gas gas(config);
    gas.run(sample.warmUp);
    const Vec2 energy = gas.twiceEnergy();
    const Vec2 relative = gas.relativeSpeed();
    Figures figures;
    std::vector<double> rates;
    std::vector<double> pressures;
    for (int i = 0; i < blocks; ++i) {
        const GasTally t = gas.run(sample.time / blocks);
        const Vec2 k = 2 * t.pairHits.cwiseQuotient(relative) / t.time;
        rates.push_back(1 + Gas::side * k.mean() / gas.count());
        // Over a finite time the moment, the sum of m x v, need not return: its change takes part
        // in the identity exactly, and in the pressure it is the greater part of the scatter.
        const Vec2 force = t.wallImpulse / 2 / t.time;
        const Vec2 push = force * (gas.length() - Gas::side) + t.momentChange / t.time;
        pressures.push_back(push.cwiseQuotient(energy).mean());
        const Vec2 off = push - energy - t.pairVirial / t.time;
        figures.identity =
            std::max(figures.identity, off.cwiseQuotient(energy).cwiseAbs().maxCoeff());
        figures.hits += t.pairHits.sum();
    }
    EXPECT_TRUE(gas.agreesWithWorld()) << "hits that were not reported, or not in their order";
    figures.rate = estimate(rates);
    figures.pressure = estimate(pressures);
    figures.overlap = overlap(gas.world()).max;
    std::cout << name(config.law) << ", " << name(config.precision) << ", filling "
              << config.filling << ", dt " << config.dt << " s, seed " << config.seed << ", "
              << std::fixed << std::setprecision(0) << figures.hits << " pair hits in "
              << sample.time << " s: 1 + S K / N = " << std::setprecision(5) << figures.rate.mean
              << " +- " << figures.rate.error << ", pressure " << figures.pressure.mean << " +- "
              << figures.pressure.error << std::defaultfloat << ", identity within "
              << std::setprecision(2) << figures.identity << '\n'
              << std::setprecision(6);
    return figures;
}

void expectWithin(const Estimate& measured, const GasState& state) {
    const double error = std::hypot(measured.error, state.error);
    EXPECT_NEAR(measured.mean, state.compressibility, 4 * error)
        << "four standard errors are " << 4 * error;
}

}  // namespace

void expectExactStatistics(const GasState& state, const GasConfig& config, const Sample& sample,
                           double identity) {
    const Figures figures = measure(config, sample);
    EXPECT_GT(figures.hits, 10'000);
    {
        SCOPED_TRACE("rate of pair hits");
        expectWithin(figures.rate, state);
    }
    {
        SCOPED_TRACE("pressure on the walls");
        expectWithin(figures.pressure, state);
    }
    EXPECT_LE(figures.identity, identity);
    EXPECT_LE(figures.overlap, config.precision == Precision::Double ? 0 : 1e-4);
}

Bias measureBias(const GasState& state, const GasConfig& config, const Sample& sample) {
    const Figures figures = measure(config, sample);
    const double excess = state.compressibility - 1;
    return {{(figures.rate.mean - 1) / excess - 1, figures.rate.error / excess}, figures.identity};
}

void expectSpeedsKeepTheirBits(Law law, Precision precision, std::uint64_t entities,
                               std::uint64_t steps) {
    Scene scene = loadScene(QUADRILLE_SCENES_DIR "/balanced.toml", {.entities = entities});
    Simulation sim(std::move(scene.world),
                   {.law = law, .precision = precision, .step = scene.step});
    const auto speeds = [&] {
        return sim.world().visitBodies([](const auto& bodies) {
            std::vector<double> vx;
            std::vector<double> vy;
            for (std::size_t i = 0; i < bodies.moving.size(); ++i) {
                vx.push_back(std::abs(bodies.moving.vx[i]));
                vy.push_back(std::abs(bodies.moving.vy[i]));
            }
            std::sort(vx.begin(), vx.end());
            std::sort(vy.begin(), vy.end());
            return std::pair(vx, vy);
        });
    };
    const auto before = speeds();
    std::uint64_t collisions = 0;
    for (std::uint64_t i = 0; i < steps; ++i) collisions += sim.step().collisions;
    std::cout << name(law) << ", " << name(precision) << ", " << entities << " bodies, " << steps
              << " steps: " << collisions << " collisions\n";
    EXPECT_EQ(speeds(), before);
    EXPECT_GT(collisions, entities);
    EXPECT_EQ(escaped(sim.world()), 0u);
}

}  // namespace quadrille::accuracy
