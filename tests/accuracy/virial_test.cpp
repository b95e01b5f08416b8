// The wall identity on motions that can be followed by hand.

#include "accuracy/virial.hpp"

#include <gtest/gtest.h>

#include <quadrille/quadrille.hpp>

#include "collision/support.hpp"

namespace quadrille::accuracy {
namespace {

/// A square of 1 px between walls whose faces are at -3 and 3, going right at 1 px/s from the
/// middle.
World between() {
    World world({.size = {10, 10}});
    makeBox(world, {-4, 0}, fixed(), {2, 10});
    makeBox(world, {4, 0}, fixed(), {2, 10});
    makeBox(world, {0, 0}, moving(1), {1, 1});
    return world;
}

/// Runs a law and keeps the balance.
Vec2 residualOf(World world, const SimulationConfig& config, int steps) {
    Simulation sim(std::move(world), config);
    VirialBalance balance(sim.world());
    sim.onContact([&](const Contact& contact) { balance.collide(contact); });
    sim.onStep(
        [&](const World& now, const StepReport&) { balance.finishStep(now, config.step.dt); });
    sim.run(std::uint64_t(steps));
    return balance.residual();
}

TEST(VirialBalance, FreeFlightBalances) {
    World world({.size = {10, 10}});
    makeBox(world, {1, 2}, moving(3, -1, 2), {1, 1});
    const Vec2 residual = residualOf(std::move(world), {.step = {.dt = 1.0 / 64}}, 64);
    EXPECT_EQ(residual.x(), 0);
    EXPECT_EQ(residual.y(), 0);
}

TEST(VirialBalance, WallsPushBack) {
    for (const Law law : {Law::Impulse, Law::Continuous}) {
        const Vec2 residual =
            residualOf(between(), {.law = law, .step = {.dt = 1.0 / 64}}, 64 * 20);
        EXPECT_EQ(residual.x(), 0);
        EXPECT_EQ(residual.y(), 0);
    }
}

TEST(VirialBalance, AHitThatIsNotReportedIsMissing) {
    Simulation sim(between(), {.step = {.dt = 1.0 / 64}});
    VirialBalance balance(sim.world());
    sim.onStep([&](const World& now, const StepReport&) { balance.finishStep(now, 1.0 / 64); });
    sim.run(64 * 5);
    // One hit at x = 2.5, impulse -2: 5 px of the way in 5 s at 1 px/s.
    EXPECT_DOUBLE_EQ(balance.residual().x(), -1);
}

TEST(VirialBalance, PairsOfUnequalMassAndSizeBalance) {
    World world({.size = {100, 100}});
    world.addWalls();
    makeBox(world, {-5, 0}, moving(3, 1, 2), {4, 2});
    makeBox(world, {5, 1}, moving(-1, 0, 7), {6, 3});
    const Vec2 residual = residualOf(std::move(world), {.law = Law::Continuous}, 6000);
    EXPECT_NEAR(residual.x(), 0, 1e-12);
    EXPECT_NEAR(residual.y(), 0, 1e-12);
}

}  // namespace
}  // namespace quadrille::accuracy
