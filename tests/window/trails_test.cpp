#include "app/window/trails.hpp"

#include <gtest/gtest.h>

#include <quadrille/quadrille.hpp>

namespace quadrille::app {
namespace {

/// Two bodies, of which the first moves 2 px a step to the right and the second stands still.
Simulation twoBodies() {
    World world({.size = {1000, 100}});
    for (const double vx : {2.0, 0.0}) {
        const Entity body = world.create();
        world.add(body, Transform{{0, 20 * vx}}, BoxCollider{{1, 1}},
                  PhysicsBody{.velocity = {vx, 0}});
    }
    return Simulation(std::move(world), {.law = Law::Impulse, .step = {.dt = 1}});
}

TEST(Trails, ABodysPlacesInTheLastSteps) {
    Simulation run = twoBodies();
    Trails trails;
    trails.record(run.world(), 0);
    for (int i = 0; i < 10; ++i) {
        run.step();
        trails.record(run.world(), run.stepsDone());
    }
    const auto trail = trails.of(0, 10, 4);
    ASSERT_EQ(trail.size(), 5u);
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_EQ(trail[k].x, float(2 * (6 + k)));
        EXPECT_EQ(trail[k].y, 40);
    }
    EXPECT_EQ(trails.of(1, 10, 4).back().x, 0);
    // From the past, what was before it.
    EXPECT_EQ(trails.of(0, 3, 100).size(), 4u);
    EXPECT_EQ(trails.of(0, 3, 100).back().x, 6);
}

TEST(Trails, EndAtAGap) {
    Simulation run = twoBodies();
    Trails trails;
    for (const std::uint64_t step : {1, 2, 5, 6, 7}) trails.record(run.world(), step);
    EXPECT_EQ(trails.of(0, 7, 100).size(), 3u);
    EXPECT_EQ(trails.of(0, 4, 100).size(), 0u);
    EXPECT_EQ(trails.of(0, 2, 100).size(), 2u);
    EXPECT_EQ(trails.of(2, 7, 100).size(), 0u);
}

TEST(Trails, WhatIsFarFromNowGoesFirst) {
    Simulation run = twoBodies();
    Trails trails;
    for (std::uint64_t step = 0; step < Trails::mostSteps + 100; ++step) {
        trails.record(run.world(), step);
    }
    EXPECT_EQ(trails.of(0, Trails::mostSteps + 99, 10'000).size(), Trails::mostSteps);
    // Back at the start, the end is far.
    for (std::uint64_t step = 100; step-- > 0;) trails.record(run.world(), step);
    EXPECT_EQ(trails.of(0, 150, 1'000).size(), 151u);
    EXPECT_EQ(trails.of(0, Trails::mostSteps + 99, 1'000).size(), 0u);
}

}  // namespace
}  // namespace quadrille::app
