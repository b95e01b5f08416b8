// A simulation and the reference side by side.

#include "accuracy/error_meter.hpp"

#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/quadrille.hpp>

#include "collision/support.hpp"
#include "core/world_access.hpp"
#include "reference/support.hpp"

namespace quadrille::accuracy {
namespace {

struct Outcome {
    ErrorMetrics metrics;
    std::uint64_t hash = 0;
};

Outcome measure(World world, const SimulationConfig& config, int frames) {
    Simulation sim(std::move(world), config);
    ErrorMeter meter(sim);
    for (int i = 0; i < frames; ++i) {
        sim.step();
        meter.follow();
    }
    return {meter.metrics(), stateHash(sim.world())};
}

World golden(const std::string& name) {
    return loadScene(std::string(QUADRILLE_TEST_DATA) + "/golden/" + name + ".toml").world;
}

/// The scene of the known answers' table (section 7), with places off the lattice: on it, several
/// boxes meet at one instant, where no answer is the exact one.
World crowd13k() {
    const Scene scene = shippedScene("demo13k");
    World world(scene.world.config());
    world.addWalls();
    Random random(3);
    scene.world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        for (std::size_t i = 0; i < m.size(); ++i) {
            const double x = double(m.x[i]) + random.uniform(-1, 1);
            const double y = double(m.y[i]) + random.uniform(-1, 1);
            makeBox(world, {x, y}, moving(m.vx[i], m.vy[i]), {3, 3});
        }
    });
    return world;
}

/// Two unit squares on one line, a distance of 4 px between them, closing at 4 px/s: they touch
/// after 1 s.
World headOn(double massOfSecond = 1) {
    World world({.size = {40, 40}});
    makeBox(world, {-2.5, 0}, moving(2), {1, 1});
    makeBox(world, {2.5, 0}, moving(-2, 0, massOfSecond), {1, 1});
    return world;
}

TEST(ErrorMeter, TheGoldenRunsAreExactWithTheLawContinuous) {
    for (const std::string name : {"small64", "A1700", "dense1600"}) {
        for (const double dt : {1.0 / 16, 1.0 / 60}) {
            SCOPED_TRACE(name + ", dt " + std::to_string(dt));
            const auto [m, hash] =
                measure(golden(name),
                        {.law = Law::Continuous, .step = {.dt = dt}, .countMissedPairs = true},
                        int(std::lround(1 / dt)));
            EXPECT_EQ(m.horizon, 1);
            EXPECT_GT(m.events.exact, 30u);
            EXPECT_EQ(m.events.recall(), 1);
            EXPECT_EQ(m.events.precision(), 1);
            EXPECT_EQ(m.wrongBodies, 0u);
            EXPECT_EQ(m.velocityTolerance, 0);
            EXPECT_EQ(m.positionError.max, 0);
            EXPECT_EQ(m.length, 3);
            EXPECT_EQ(m.escaped, 0u);
            EXPECT_EQ(m.overlapMax, 0);
            EXPECT_EQ(m.energyDrift, 0);
            EXPECT_EQ(m.speedDrift, 0);
            ASSERT_TRUE(m.wallIdentity);
            // Sums of thousands of terms, of which each is rounded.
            EXPECT_LT(m.wallIdentity->cwiseAbs().maxCoeff(), 1e-12);
            EXPECT_EQ(m.auditedSteps, std::uint64_t(std::lround(1 / dt)));
            EXPECT_GT(m.overlappingPairs, 0u);
            EXPECT_EQ(m.broadPhaseRecall(), 1);
        }
    }
}

TEST(ErrorMeter, CountsBodiesAsTheyWereCreatedAndNotByRows) {
    const auto metrics = [](bool permuted) {
        World world = golden("small64");
        if (permuted) {
            const auto order = [](std::size_t rows) {
                std::vector<std::uint32_t> result;
                for (std::size_t i = 0; i < rows; ++i) {
                    result.push_back(static_cast<std::uint32_t>((i + rows / 2) % rows));
                }
                return result;
            };
            WorldAccess::permute(world, order(world.movingCount()), order(world.staticCount()));
        }
        return measure(std::move(world), {.law = Law::Impulse}, 60).metrics;
    };
    const ErrorMetrics plain = metrics(false);
    const ErrorMetrics permuted = metrics(true);
    EXPECT_GT(plain.events.matched, 30u);
    EXPECT_EQ(permuted.events.matched, plain.events.matched);
    EXPECT_EQ(permuted.wrongBodies, plain.wrongBodies);
    EXPECT_EQ(permuted.positionError.max, plain.positionError.max);
    ASSERT_TRUE(plain.wallIdentity && permuted.wallIdentity);
    EXPECT_EQ(*permuted.wallIdentity, *plain.wallIdentity);
}

TEST(ErrorMeter, CountsTheGoldenCollisions) {
    const auto rows = reference::readCsv("dense1600_events.csv");
    std::uint64_t early = 0;
    for (const auto& row : rows) early += row[0] <= 0.25;
    const ErrorMetrics m =
        measure(golden("dense1600"), {.law = Law::Impulse, .step = {.dt = 1.0 / 240}}, 60).metrics;
    EXPECT_EQ(m.events.exact, early);
}

/// Section 7 of the known answers has .742 to .921 for the simple schemes at 1/60 and a bias of
/// some per cent, measured with another program on another start; so the brackets are wide, but
/// leave no room for a law that is twice as bad, or for a metric that is blind.
TEST(ErrorMeter, TheDiscreteLawsStandNearTheTableOfTheKnownAnswers) {
    const ErrorMetrics impulse =
        measure(crowd13k(), {.law = Law::Impulse, .countMissedPairs = true}, 30).metrics;
    // "Impulse moved back to its time of impact": .921, .948, 11 %, -2.9 %, 2.0 px.
    EXPECT_NEAR(impulse.events.recall(), 0.921, 0.04);
    EXPECT_NEAR(impulse.events.precision(), 0.948, 0.03);
    EXPECT_NEAR(impulse.wrongBodyFraction(), 0.11, 0.05);
    EXPECT_NEAR(*impulse.events.rateBias(), -0.029, 0.02);
    EXPECT_GT(impulse.overlapMax, 0.01);
    EXPECT_LT(impulse.overlapMax, 1);
    EXPECT_EQ(impulse.speedDrift, 0);
    EXPECT_LT(impulse.wallIdentity->cwiseAbs().maxCoeff(), 0.01);
    EXPECT_EQ(impulse.broadPhaseRecall(), 1);

    const ErrorMetrics fine =
        measure(crowd13k(), {.law = Law::Impulse, .step = {.dt = 1.0 / 960}}, 480).metrics;
    // At 1/960: .995, .996, .9 %, -.2 %.
    EXPECT_NEAR(fine.events.recall(), 0.995, 0.004);
    EXPECT_NEAR(fine.events.precision(), 0.996, 0.004);
    EXPECT_NEAR(fine.wrongBodyFraction(), 0.009, 0.008);
    EXPECT_LT(fine.overlapMax, impulse.overlapMax / 4);

    const ErrorMetrics baseline =
        measure(crowd13k(), {.partitioner = Quadtree{}, .law = Law::Baseline}, 30).metrics;
    // "The report's law": .700, .649, 41 %, +8 %. This port of it does better.
    EXPECT_NEAR(baseline.events.recall(), 0.75, 0.1);
    EXPECT_NEAR(baseline.events.precision(), 0.70, 0.1);
    EXPECT_GT(baseline.wrongBodyFraction(), 0.2);
    EXPECT_LT(baseline.wrongBodyFraction(), 0.45);
    EXPECT_GT(*baseline.events.rateBias(), 0.02);
    EXPECT_GT(*baseline.speedDrift, 0);
}

TEST(ErrorMeter, TheErrorOfFloatIsMeasuredFromItsOwnStart) {
    const auto [m, hash] =
        measure(crowd13k(), {.law = Law::Continuous, .precision = Precision::Float}, 30);
    EXPECT_EQ(m.events.recall(), 1);
    EXPECT_EQ(m.events.precision(), 1);
    EXPECT_EQ(m.wrongBodies, 0u);
    EXPECT_EQ(m.velocityTolerance, 0);
    EXPECT_GT(m.positionError.max, 0);
    EXPECT_LT(m.positionError.max, 1e-4);
}

TEST(ErrorMeter, AMissedBounceIsSeen) {
    // The law `impulse` passes a wall that a body crosses within a step.
    const ErrorMetrics m = measure(shippedScene("bullet").world, {.law = Law::Impulse}, 2).metrics;
    EXPECT_EQ(m.events.exact, 1u);
    EXPECT_EQ(m.events.measured, 0u);
    EXPECT_EQ(m.events.recall(), 0);
    EXPECT_EQ(m.wrongBodies, 1u);
    EXPECT_EQ(m.wrongBodyFraction(), 1);
    EXPECT_GT(m.positionError.median, 1);
    EXPECT_EQ(m.speedDrift, 0);  // it still is as fast
}

TEST(ErrorMeter, UnequalMassesAreComparedWithATolerance) {
    const ErrorMetrics m = measure(headOn(3), {.step = {.dt = 1.0 / 64}}, 128).metrics;
    EXPECT_EQ(m.events.matched, 1u);
    EXPECT_EQ(m.wrongBodies, 0u);
    EXPECT_GT(m.velocityTolerance, 1e-9);
    EXPECT_LT(m.velocityTolerance, 1e-6);
    EXPECT_EQ(m.speedDrift, std::nullopt);  // speeds change
    EXPECT_LT(std::abs(m.energyDrift), 1e-12);
}

TEST(ErrorMeter, GravityAndRestitutionHaveTheirReference) {
    World world({.size = {40, 40}});
    makeBox(world, {0, -10}, fixed(), {40, 2});
    makeBox(world, {0, 0}, moving(1), {1, 1});
    const ErrorMetrics m =
        measure(std::move(world),
                {.step = {.dt = 1.0 / 960, .gravity = {0, -50}, .restitution = 0.5}}, 960)
            .metrics;
    EXPECT_GE(m.events.exact, 1u);
    EXPECT_GT(m.events.recall(), 0.5);
    EXPECT_LT(m.positionError.max, 0.5);
    EXPECT_EQ(m.speedDrift, std::nullopt);
    EXPECT_EQ(m.wallIdentity, std::nullopt);
}

// Which of several events at one instant comes first is a choice, and both make the same.
TEST(ErrorMeter, ScenesFullOfTiesAreExactWithTheLawContinuous) {
    for (const auto& [name, entities] : {std::pair("demo13k", 13400), {"balanced-scaled", 3000}}) {
        SCOPED_TRACE(name);
        Scene scene = shippedScene(name, static_cast<std::uint64_t>(entities));
        const ErrorMetrics m =
            measure(std::move(scene.world), {.law = Law::Continuous, .step = scene.step}, 60)
                .metrics;
        EXPECT_GT(m.events.exact, 1000u);
        EXPECT_EQ(m.events.recall(), 1);
        EXPECT_EQ(m.events.precision(), 1);
        EXPECT_EQ(m.wrongBodies, 0u);
        EXPECT_EQ(m.positionError.max, 0);
        EXPECT_EQ(m.pushedCollisions + m.jammedCollisions, 0u);
    }
}

// What lies on each other is hit again within 1e-11 s, in an order that rounding decides; so some
// bodies differ, but few, and little.
TEST(ErrorMeter, AHeapIsNearItsReference) {
    Scene scene = shippedScene("pile");
    const ErrorMetrics m =
        measure(std::move(scene.world), {.law = Law::Continuous, .step = scene.step}, 60).metrics;
    EXPECT_GT(m.pushedCollisions, 1000u);
    EXPECT_GT(m.events.recall(), 0.8);
    EXPECT_GT(m.events.precision(), 0.8);
    EXPECT_LT(m.positionError.median, 1e-9);
    EXPECT_LT(m.positionError.p99, 0.5);
}

TEST(ErrorMeter, ACrowdThatOverlapsAtTheStartHasItsReference) {
    Scene scene = shippedScene("imbalanced", 400);
    const ErrorMetrics m =
        measure(std::move(scene.world), {.law = Law::Continuous, .step = scene.step}, 10).metrics;
    EXPECT_NEAR(m.events.rateBias().value(), 0, 0.2);
}

TEST(ErrorMeter, PairsMissedByAStaleTreeAreCounted) {
    SimulationConfig config{
        .partitioner = SemiStaticQuadtree{10, 1, SemiStaticQuadtree::EveryFrames{200}},
        .law = Law::Impulse,
        .step = {.dt = 1.0 / 64},
        .countMissedPairs = true};
    const ErrorMetrics m = measure(headOn(), config, 80).metrics;
    EXPECT_EQ(m.auditedSteps, 80u);
    EXPECT_GT(m.missedPairs, 0u);
    EXPECT_EQ(m.overlappingPairs, m.missedPairs);
    EXPECT_EQ(m.broadPhaseRecall(), 0);
    EXPECT_EQ(m.events.recall(), 0);
    // Sixteen steps after the hit they are nearly all the way inside each other.
    EXPECT_GT(m.overlapMax, 0.9);
}

TEST(ErrorMeter, StartsAnywhereInARun) {
    for (const Law law : {Law::Impulse, Law::Continuous}) {
        Simulation sim(golden("small64"), {.law = law});
        sim.run(30);
        ErrorMeter meter(sim);
        for (int i = 0; i < 30; ++i) sim.step();
        meter.follow();
        const ErrorMetrics m = meter.metrics();
        EXPECT_NEAR(m.horizon, 0.5, 1e-12);
        EXPECT_GT(m.events.exact, 50u);
        EXPECT_GT(m.events.recall(), law == Law::Continuous ? 0.999 : 0.5);
    }
}

TEST(ErrorMeter, SlicesDoNotChangeTheResult) {
    const auto sliced = measure(golden("small64"), {}, 40).metrics;
    Simulation sim(golden("small64"), {});
    ErrorMeter meter(sim);
    sim.run(40);
    meter.follow();
    const ErrorMetrics whole = meter.metrics();
    EXPECT_EQ(whole.events.matched, sliced.events.matched);
    EXPECT_EQ(whole.events.exact, sliced.events.exact);
    EXPECT_EQ(whole.positionError.p99, sliced.positionError.p99);
}

TEST(ErrorMeter, LeavesTheRunAsItIs) {
    Simulation plain(golden("small64"), {});
    plain.run(40);
    EXPECT_EQ(measure(golden("small64"), {.countMissedPairs = true}, 40).hash,
              stateHash(plain.world()));
}

TEST(ErrorMeter, RefusesBodiesThatComeAndGo) {
    Simulation sim(golden("small64"), {});
    ErrorMeter meter(sim);
    makeBox(sim.world(), {0, 0}, moving(1));
    sim.step();
    meter.follow();
    EXPECT_THROW(meter.metrics(), Error);
}

}  // namespace
}  // namespace quadrille::accuracy
