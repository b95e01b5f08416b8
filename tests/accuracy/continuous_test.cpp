#include <cstdint>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/state_hash.hpp>

#include "hard_cases/hard_case.hpp"

// What the law `continuous` promises beyond the table of hard cases.

namespace quadrille {
namespace {

using accuracy::Body;
using accuracy::velocity;

Simulation simulate(const std::vector<Body>& bodies, double dt = 1.0 / 60) {
    return accuracy::simulate({Law::Continuous, Precision::Double}, bodies, {.step = {.dt = dt}});
}

TEST(Continuous, BulletMeetsTheThinWallWhateverTheStep) {
    for (const double dt : {1.0 / 60, 1.0 / 16, 1.0}) {
        Simulation sim =
            simulate({{{-50, 0}, {6000, 0}}, {{0, 0}, {0, 0}, {0.1, 50}, 1, true}}, dt);
        std::vector<double> times;
        sim.onContact([&](const Contact& c) { times.push_back(c.time); });
        sim.step();
        ASSERT_EQ(times.size(), 1u);
        EXPECT_NEAR(times[0], 989.0 / 120000, 1e-17);
        EXPECT_EQ(velocity(sim, 0), Vec2(-6000, 0));
    }
}

TEST(Continuous, OverlapsKeepEnergyAndSeparate) {
    for (const Vec2& offset : {Vec2(0, 0), Vec2(0.5, 0.1), Vec2(-0.2, 0.6)}) {
        Simulation sim = simulate({{{0, 0}, {2, 1}}, {offset, {-1, 3}}});
        const double energy = kineticEnergy(sim.world());
        const Vec2 sum = momentum(sim.world());
        sim.run(600);
        EXPECT_EQ(kineticEnergy(sim.world()), energy);
        EXPECT_EQ(momentum(sim.world()), sum);
        EXPECT_EQ(overlap(sim.world()).pairs, 0u);
    }
}

TEST(Continuous, GoesOnFromASnapshotBitForBit) {
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        const auto start = [&] {
            Scene scene = loadScene(QUADRILLE_SCENES_DIR "/mixed-sizes.toml", {.entities = 300});
            return Simulation(std::move(scene.world),
                              {.law = Law::Continuous, .precision = precision});
        };
        Simulation whole = start();
        whole.run(400);
        Simulation first = start();
        first.run(150);
        const auto file = std::filesystem::temp_directory_path() / "quadrille_continuous.snapshot";
        saveSnapshot(file, first, "mixed-sizes", 1);
        Snapshot snapshot = loadSnapshot(file);
        std::filesystem::remove(file);
        Simulation second(std::move(snapshot.world), {.partitioner = StaticGrid{},
                                                      .law = snapshot.law,
                                                      .precision = precision,
                                                      .step = {.dt = snapshot.step.dt}});
        second.resumeAt(snapshot.stepsDone);
        second.run(250);
        EXPECT_EQ(stateHash(second.world()), stateHash(whole.world()));
    }
}

// A step goes on in time whatever the speeds are, or says that positions are no longer numbers.
TEST(Continuous, StepsEndWhateverTheSpeedsAre) {
    for (const double speed : {1e6, 1e30, 1e100, 1e154, 1e300, 1e308}) {
        for (const ResolverKind resolver : {ResolverKind::Sequential, ResolverKind::Threads}) {
            for (const int count : {2, 60}) {
                SCOPED_TRACE(std::to_string(count) + " bodies at " + std::to_string(speed));
                std::vector<Body> bodies;
                for (int i = 0; i < count; ++i) {
                    const double sign = i % 2 == 0 ? 1 : -1;
                    bodies.push_back({{3.0 * i, 0.5 * (i % 3)}, {sign * speed, -sign * speed / 3}});
                }
                World world;
                for (const Body& body : bodies) {
                    world.add(world.create(), Transform{body.position}, BoxCollider{body.size},
                              PhysicsBody{.velocity = body.velocity});
                }
                Simulation sim(std::move(world), {.law = Law::Continuous,
                                                  .resolver = resolver,
                                                  .threads = 2,
                                                  .step = {.dt = 1}});
                const double before = kineticEnergy(sim.world());
                try {
                    sim.run(3);
                    EXPECT_EQ(kineticEnergy(sim.world()), before);
                } catch (const Error& error) {
                    EXPECT_NE(std::string(error.what()).find("no longer finite"), std::string::npos)
                        << error.what();
                }
            }
        }
    }
}

// How many pairs are looked at follows from what happens and not from how time is cut into steps.
TEST(Continuous, LongStepsLookAtNoMorePairsThanShortOnes) {
    const auto run = [](double dt, std::uint64_t steps, std::uint64_t& pairs) {
        World world({.size = {240, 240}, .seed = 5});
        world.addWalls({.thickness = 20});
        for (int i = 0; i < 400; ++i) {
            const Vec2 velocity(world.random().uniform(-30, 30), world.random().uniform(-30, 30));
            const int row = i / 20;
            world.add(world.create(), Transform{{12.0 * (i % 20) - 114, 12.0 * row - 114}},
                      BoxCollider{{2, 2}}, PhysicsBody{.velocity = velocity});
        }
        Simulation sim(std::move(world), {.law = Law::Continuous, .step = {.dt = dt}});
        for (std::uint64_t i = 0; i < steps; ++i) pairs += sim.step().pairsTested;
        return stateHash(sim.world());
    };
    std::uint64_t inLong = 0;
    std::uint64_t inShort = 0;
    EXPECT_EQ(run(256, 1, inLong), run(0.25, 1024, inShort));
    EXPECT_LT(inLong, 1.2 * static_cast<double>(inShort));
}

TEST(Continuous, StepsOfNothingThatMovesEndHoweverLongTheyAre) {
    for (const double dt : {1e-9, 1.0, 1e9, 1e300}) {
        Simulation sim = simulate({{{0, 0}, {0, 0}, {1, 50}, 1, true}}, dt);
        sim.run(2);
        EXPECT_EQ(sim.stepsDone(), 2u);
    }
}

}  // namespace
}  // namespace quadrille
