// Bodies under gravity against a static floor, with the law `impulse`.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <quadrille/measure.hpp>
#include <quadrille/names.hpp>

#include "collision/support.hpp"

namespace quadrille {
namespace {

class Gravity : public testing::TestWithParam<Precision> {
  protected:
    SimulationConfig config(double restitution) const {
        return {.law = Law::Impulse,
                .precision = GetParam(),
                .step = {.gravity = {0, -200}, .restitution = restitution}};
    }
};

INSTANTIATE_TEST_SUITE_P(Precisions, Gravity, testing::Values(Precision::Double, Precision::Float),
                         [](const auto& test) { return std::string(name(test.param)); });

TEST_P(Gravity, ABoxAtRestStaysAndDoesNotSink) {
    for (const double e : {0.0, 0.5}) {
        SCOPED_TRACE(e);
        World world;
        makeBox(world, {0, -10}, fixed(), {200, 20});
        const Entity box = makeBox(world, {3, 4}, {}, {8, 8});
        Simulation sim(std::move(world), config(e));
        for (int i = 0; i < 10000; ++i) {
            sim.step();
            // The surface is at 4 for the centre of the box; rounding is all it may be off.
            ASSERT_NEAR(positionOf(sim, box).y(), 4, 1e-5) << "step " << i;
        }
        EXPECT_EQ(positionOf(sim, box).x(), 3);
        EXPECT_EQ(velocityOf(sim, box).x(), 0);
        EXPECT_NEAR(velocityOf(sim, box).y(), 0, 1e-9);
    }
}

/// Where floor and box lie decides whether rounding lets them overlap by an ulp.
void expectRest(SimulationConfig config, double tolerance) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const double floor = random.uniform(-300, 300);
        const double thickness = random.uniform(1, 30);
        const double side = random.uniform(1, 30);
        World world;
        makeBox(world, {0, floor - thickness / 2}, fixed(), {200, thickness});
        const Entity box = makeBox(world, {0, floor + side / 2}, {}, {side, side});
        Simulation sim(std::move(world), config);
        const double start = positionOf(sim, box).y();
        for (int i = 0; i < 200; ++i) {
            sim.step();
            ASSERT_NEAR(positionOf(sim, box).y(), start, tolerance) << "step " << i;
        }
    }
}

TEST_P(Gravity, ABoxAtRestStaysWhereverRoundingPutsIt) {
    const double rounding = GetParam() == Precision::Double ? 1e-12 : 3e-4;
    for (const double e : {0.0, 0.5}) {
        SCOPED_TRACE(e);
        expectRest(config(e), rounding);
    }
}

TEST_P(Gravity, AnElasticBoxAtRestStaysWhereverRoundingPutsIt) {
    // Rounding may add up here, as nothing takes energy out. A box that reflects the velocity of
    // one step, though it never fell, hops by g dt^2 / 8 = 0.007.
    expectRest(config(1), GetParam() == Precision::Double ? 1e-10 : 2e-3);
}

TEST_P(Gravity, ABoxThatFallsComesToRestOnTheFloor) {
    for (const double e : {0.0, 0.5}) {
        SCOPED_TRACE(e);
        World world;
        makeBox(world, {0, -10}, fixed(), {200, 20});
        const Entity box = makeBox(world, {3, 50}, {}, {8, 8});
        Simulation sim(std::move(world), config(e));
        for (int i = 0; i < 2000; ++i) {
            sim.step();
            ASSERT_GT(positionOf(sim, box).y(), 4 - 1e-4) << "step " << i;
        }
        EXPECT_NEAR(positionOf(sim, box).y(), 4, 1e-3);
    }
}

TEST_P(Gravity, ABoxThatBouncesKeepsItsEnergyAndItsPeriod) {
    constexpr double height = 90;
    constexpr double g = 200;
    World world;
    makeBox(world, {0, -10}, fixed(), {200, 20});
    const Entity box = makeBox(world, {0, 1 + height}, {}, {2, 2});
    Simulation sim(std::move(world), config(1));
    const double start = g * height;  // energy above the floor, a mass of 1
    double worst = 0;
    std::vector<double> hits;
    sim.onContact([&](const Contact& c) {
        if (c.collided) hits.push_back(c.time);
    });
    for (int i = 0; i < 60 * 60; ++i) {
        sim.step();
        const double v = velocityOf(sim, box).y();
        const double now = v * v / 2 + g * (positionOf(sim, box).y() - 1);
        worst = std::max(worst, std::abs(now / start - 1));
    }
    // Velocity and position of the step's rule, v += a dt; x += v dt, belong to times half a step
    // apart, so that the sum swings by a dt v / 2, 1.76 % of it at the floor, and may not drift.
    EXPECT_LT(worst, 0.02);

    ASSERT_GT(hits.size(), 10u);
    const double period = (hits.back() - hits.front()) / double(hits.size() - 1);
    const double exact = 2 * std::sqrt(2 * height / g);
    EXPECT_NEAR(period / exact, 1, 0.01) << period / exact;
}

TEST_P(Gravity, BoxesPiledUpDoNotFallThroughTheFloor) {
    Simulation sim = simulationOf(shippedScene("pile", 200), SemiStaticQuadtree{}, GetParam());
    double deepest = 0;
    for (int i = 0; i < 600; ++i) {
        sim.step();
        sim.world().visitBodies([&](const auto& bodies) {
            for (const double y : bodies.moving.y) deepest = std::max(deepest, -150 + 4 - y);
        });
    }
    EXPECT_LT(deepest, 4) << "a centre went through the floor";
    EXPECT_EQ(escaped(sim.world()), 0u);
}

}  // namespace
}  // namespace quadrille
