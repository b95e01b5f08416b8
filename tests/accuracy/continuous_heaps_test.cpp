// The law `continuous` in heaps, between tight walls and in jams: every step ends, nothing leaves,
// overlaps or gains energy, and what can come to rest does.

#include <cmath>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <quadrille/quadrille.hpp>

#include "hard_cases/hard_case.hpp"

namespace quadrille {
namespace {

using accuracy::Body;
using accuracy::position;
using accuracy::velocity;

constexpr double down = -200;  // px/s^2

/// Place i of a lattice that is filled row by row from its first place on.
Vec2 latticePlace(int i, int columns, const Vec2& first, const Vec2& pitch) {
    const int row = i / columns;
    return first + Vec2(pitch.x() * (i % columns), pitch.y() * row);
}

struct HeapScene {
    const char* name;
    Vec2 size;            // of the container
    bool standsSideways;  // nothing moves along x, so that all comes to rest
    std::function<void(std::vector<Body>&, Random&)> fill;
};

std::ostream& operator<<(std::ostream& out, const HeapScene& scene) { return out << scene.name; }

const HeapScene heapScenes[] = {
    {"Tall",
     {120, 700},
     false,
     [](auto& bodies, Random& random) {
         for (int i = 0; i < 400; ++i) {
             bodies.push_back({latticePlace(i, 10, {-50, -330}, {11, 11}),
                               {random.uniform(-20, 20), random.uniform(-20, 20)},
                               {8, 8}});
         }
     }},
    {"Columns",
     {120, 700},
     true,
     [](auto& bodies, Random& random) {
         for (int i = 0; i < 400; ++i) {
             bodies.push_back({latticePlace(i, 10, {-50, -330}, {11, 11}) +
                                   Vec2(random.uniform(-1, 1), random.uniform(-1, 1)),
                               {0, random.uniform(-20, 20)},
                               {8, 8}});
         }
     }},
    {"Pyramid",
     {400, 200},
     true,
     [](auto& bodies, Random&) {
         for (int row = 0; row < 16; ++row) {
             for (int i = 0; i < 16 - row; ++i) {
                 bodies.push_back(
                     {{10.0 * i - 5.0 * (15 - row), -94 + 10.01 * row}, {0, 0}, {9.9, 9.9}});
             }
         }
     }},
    {"HeavyOnTop",
     {160, 260},
     true,
     [](auto& bodies, Random& random) {
         for (int i = 0; i < 96; ++i) {
             bodies.push_back({latticePlace(i, 8, {-70 + random.uniform(-3, 3), -120}, {20, 18}),
                               {0, 0},
                               {12, 12},
                               std::pow(10, 4 * latticePlace(i, 8, {0, 0}, {0, 1}).y() / 11)});
         }
     }},
    {"UnequalSizes",
     {300, 400},
     true,
     [](auto& bodies, Random& random) {
         for (int i = 0; i < 120; ++i) {
             const Vec2 size(random.uniform(2, 20), random.uniform(2, 20));
             bodies.push_back({latticePlace(i, 10, {-135 + random.uniform(-4, 4), -180}, {30, 28}),
                               {0, 0},
                               size,
                               size.x() * size.y()});
         }
     }},
    {"Galton",
     {200, 500},
     true,
     [](auto& bodies, Random& random) {
         for (int i = 0; i < 60; ++i) {
             bodies.push_back({latticePlace(i, 10, {-95.0 + i / 10 % 2 * 10, -60}, {20, 20}),
                               {0, 0},
                               {4, 4},
                               1,
                               true});
         }
         for (int i = 0; i < 200; ++i) {
             bodies.push_back({latticePlace(i, 20, {-95 + random.uniform(-1, 1), 80}, {9.9, 9}),
                               {0, 0},
                               {5, 5}});
         }
     }},
    {"Stairs",
     {200, 300},
     false,
     [](auto& bodies, Random& random) {
         for (int i = 0; i < 10; ++i) {
             bodies.push_back(
                 {{-90 + 20.0 * i, -150 + 4.0 * (i + 1)}, {0, 0}, {20, 8.0 * (i + 1)}, 1, true});
         }
         for (int i = 0; i < 150; ++i) {
             bodies.push_back({latticePlace(i, 15, {-90 + random.uniform(-1, 1), 10}, {12, 12}),
                               {random.uniform(-10, 10), 0},
                               {7, 7}});
         }
     }},
    {"HeapHitByAFastBox",
     {500, 240},
     false,
     [](auto& bodies, Random&) {
         for (int i = 0; i < 100; ++i) {
             bodies.push_back({latticePlace(i, 10, {-60, -116}, {8, 8}), {0, 0}, {8, 8}});
         }
         bodies.push_back({{-230, -80}, {2000, 0}, {16, 16}, 50});
     }},
};

World worldOf(const std::vector<Body>& bodies, const Vec2& size) {
    World world({.size = size});
    for (const Body& body : bodies) {
        world.add(world.create(), Transform{body.position}, BoxCollider{body.size},
                  PhysicsBody{body.velocity, body.mass, body.isStatic});
    }
    world.addWalls({.thickness = 100});
    return world;
}

Simulation heapOf(const HeapScene& scene, double restitution, SimulationConfig config = {}) {
    Random random(7);
    std::vector<Body> bodies;
    scene.fill(bodies, random);
    config.law = Law::Continuous;
    config.step.gravity = {0, down};
    config.step.restitution = restitution;
    return Simulation(worldOf(bodies, scene.size), config);
}

class Heaps : public testing::TestWithParam<std::tuple<HeapScene, double>> {};

INSTANTIATE_TEST_SUITE_P(Scenes, Heaps,
                         testing::Combine(testing::ValuesIn(heapScenes),
                                          testing::Values(0.0, 0.1, 0.2, 0.5, 0.8, 0.95)),
                         [](const auto& test) {
                             const double restitution = std::get<1>(test.param);
                             return std::string(std::get<0>(test.param).name) + "Restitution" +
                                    std::to_string(static_cast<int>(100 * restitution));
                         });

TEST_P(Heaps, EndInOrder) {
    const HeapScene& scene = std::get<0>(GetParam());
    const double restitution = std::get<1>(GetParam());
    Simulation sim = heapOf(scene, restitution);
    const Vec2 gravity(0, down);
    // Heights count from the floor, so that no sum of terms of both signs hides a gain.
    const auto energyOf = [&] {
        double mass = 0;
        sim.world().visitBodies([&](const auto& bodies) {
            for (std::size_t i = 0; i < bodies.moving.size(); ++i) mass += bodies.moving.mass[i];
        });
        return totalEnergy(sim.world(), gravity) - mass * down * scene.size.y() / 2;
    };
    const double first = energyOf();
    double energy = first;
    for (int i = 0; i < 300; ++i) {
        sim.step();
        const double now = energyOf();
        ASSERT_LE(now, energy + 1e-9 * first) << "step " << i;
        energy = now;
    }
    EXPECT_LT(energy, 0.999 * first);
    EXPECT_EQ(escaped(sim.world()), 0u);
    EXPECT_LT(overlap(sim.world()).max, 1e-7);
    if (!scene.standsSideways) return;
    sim.run(restitution > 0.9 ? 6000 : 1200);
    EXPECT_EQ(kineticEnergy(sim.world()), 0) << "it has come to rest";
    EXPECT_EQ(sim.step().contacts, 0u) << "and costs nothing any more";
}

// Windows of the search, steps, partitions and threads are choices of cost only.
TEST(HeapsAgree, WhateverTheStepThePartitionerAndTheThreads) {
    for (const HeapScene& scene : heapScenes) {
        for (const double restitution : {0.0, 0.5}) {
            SCOPED_TRACE(std::string(scene.name) + ", restitution " + std::to_string(restitution));
            const auto hashAfter = [&](int steps, SimulationConfig config) {
                config.step.dt = 1.5 / steps;
                Simulation sim = heapOf(scene, restitution, config);
                sim.run(static_cast<std::uint64_t>(steps));
                return stateHash(sim.world());
            };
            const std::uint64_t expected = hashAfter(96, {});
            EXPECT_EQ(hashAfter(24, {}), expected) << "longer steps";
            EXPECT_EQ(hashAfter(384, {.partitioner = StaticGrid{}}), expected) << "shorter steps";
            EXPECT_EQ(hashAfter(96, {.partitioner = Quadtree{4, 7},
                                     .resolver = ResolverKind::Threads,
                                     .threads = 3}),
                      expected);
        }
    }
}

// ---- what holds too tightly

/// A row of squares that exactly fits between two static boxes, with velocities along it.
Simulation tightRow(int count, double gap, double restitution) {
    std::vector<Body> bodies;
    for (int i = 0; i < count; ++i) {
        bodies.push_back({{(4 + gap) * i, 0}, {i % 3 == 0 ? 7.0 : -5.0, 0}, {4, 4}});
    }
    bodies.push_back({{-7 - gap, 0}, {0, 0}, {10, 40}, 1, true});
    bodies.push_back({{(4 + gap) * (count - 1) + 7 + gap, 0}, {0, 0}, {10, 40}, 1, true});
    return accuracy::simulate({Law::Continuous, Precision::Double}, bodies,
                              {.step = {.restitution = restitution}});
}

TEST(TightFit, StandsWhateverTheRestitution) {
    for (const double restitution : {0.0, 0.5, 1.0}) {
        for (const int count : {1, 2, 7}) {
            for (const double gap : {0.0, 1e-15, 1e-13}) {
                SCOPED_TRACE(std::to_string(count) + " squares, gap " + std::to_string(gap) +
                             ", restitution " + std::to_string(restitution));
                Simulation sim = tightRow(count, gap, restitution);
                sim.run(30);
                for (int i = 0; i < count; ++i) {
                    const auto row = static_cast<std::size_t>(i);
                    EXPECT_NEAR(position(sim, row).x(), (4 + gap) * i, 1e-8);
                    EXPECT_NEAR(velocity(sim, row).x(), 0, 1e-5);
                }
            }
        }
    }
}

TEST(TightFit, OfOneBodyStandsAfterAFewCollisionsEachTimeThatItIsHit) {
    std::vector<Body> bodies{{{0, 0}, {5, 0}, {4, 4}},
                             {{-7, 0}, {0, 0}, {10, 4}, 1, true},
                             {{7, 0}, {0, 0}, {10, 4}, 1, true},
                             // Hits the first one's corner column from above, along y.
                             {{0, 10}, {0, -12}, {4, 4}}};
    Simulation sim = accuracy::simulate({Law::Continuous, Precision::Double}, bodies);
    const accuracy::ContactLog log(sim);
    sim.run(60);
    // Eight that get nowhere, one that stops it; then the hit.
    EXPECT_EQ(log.collisions().size(), 10u);
    EXPECT_EQ(position(sim, 0).x(), 0);
    EXPECT_EQ(velocity(sim, 0), Vec2(0, -12));
    EXPECT_EQ(velocity(sim, 3), Vec2(0, 0));
}

// In a crowd no partition shows fewer pairs, however much happens there.
TEST(TightFit, InACrowdNeedsNoNewPartition) {
    std::vector<Body> bodies{{{0, 0}, {1, 0}, {4, 4}},
                             {{-7, 0}, {0, 0}, {10, 4}, 1, true},
                             {{7 + 1e-6, 0}, {0, 0}, {10, 4}, 1, true}};
    constexpr std::size_t crowd = 40;
    for (std::size_t i = 0; i < crowd; ++i)
        bodies.push_back({{0, 4 + 0.01 * double(i)}, {0, 0}, {4, 4}});
    Simulation sim = accuracy::simulate({Law::Continuous, Precision::Double}, bodies);
    const StepReport report = sim.step();
    EXPECT_GT(report.collisions, 10000u);
    EXPECT_LT(report.pairsTested, 4 * crowd * crowd);
}

TEST(TightFit, OfARowStandsWithRoomBelowTheTouchingDistance) {
    for (const int count : {1, 2, 7, 44}) {
        for (const double room : {1e-11, 1e-10, 1e-9, 2e-9}) {
            SCOPED_TRACE(std::to_string(count) + " squares, room " + std::to_string(room));
            const double gap = room / (count + 1);
            Simulation sim = tightRow(count, gap, 1);
            sim.run(3);
            for (int i = 0; i < count; ++i) {
                const auto row = static_cast<std::size_t>(i);
                EXPECT_NEAR(position(sim, row).x(), (4 + gap) * i, 1e-8);
            }
        }
    }
}

// Each square passes the velocity on at once, and few are under way: no square has many hits in a
// nanosecond, and all have millions in a step.
TEST(TightFit, StopsWhatGoesToAndFroThroughARow) {
    constexpr int count = 44;
    for (const double room : {1e-10, 2.3e-9, 2e-8}) {
        SCOPED_TRACE("room " + std::to_string(room));
        std::vector<Body> bodies;
        for (int i = 0; i < count; ++i) bodies.push_back({{3.0 * i, 0}, {0, 0}, {3, 3}});
        bodies[0].velocity = {35, 0};
        bodies.push_back({{-6.5, 0}, {0, 0}, {10, 40}, 1, true});
        bodies.push_back({{3.0 * (count - 1) + 6.5 + room, 0}, {0, 0}, {10, 40}, 1, true});
        Simulation sim = accuracy::simulate({Law::Continuous, Precision::Double}, bodies,
                                            {.step = {.restitution = 1}});
        sim.run(3);
        EXPECT_LT(kineticEnergy(sim.world()), 1e-9);
        for (int i = 0; i < count; ++i) {
            EXPECT_NEAR(position(sim, static_cast<std::size_t>(i)).x(), 3.0 * i, 1e-7);
        }
    }
}

TEST(TightFit, WithHardlyAnyRoomIsAnErrorThatNamesTheBodiesAndTheTime) {
    Simulation sim = tightRow(1, 1e-8, 1);
    try {
        sim.step();
        FAIL() << "a box that collides a billion times a second";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("entity 0 "), std::string::npos) << text;
        EXPECT_NE(text.find("with entity "), std::string::npos) << text;
        EXPECT_NE(text.find(" s;"), std::string::npos) << text;
    }
}

TEST(Jam, OfManyBodiesAtOnePlaceEnds) {
    for (const double restitution : {0.0, 0.5, 1.0}) {
        for (const double gravity : {0.0, down}) {
            Random random(3);
            std::vector<Body> bodies;
            for (int i = 0; i < 60; ++i) {
                bodies.push_back(
                    {{0, 0}, {random.uniform(-20, 20), random.uniform(-20, 20)}, {2, 2}});
            }
            Simulation sim(worldOf(bodies, {200, 200}),
                           {.law = Law::Continuous,
                            .step = {.gravity = {0, gravity}, .restitution = restitution}});
            const double before = kineticEnergy(sim.world());
            sim.run(60);
            EXPECT_EQ(escaped(sim.world()), 0u);
            if (gravity == 0) {
                EXPECT_LE(kineticEnergy(sim.world()), before * (1 + 1e-12));
            }
        }
    }
}

// ---- overlap with something that holds

TEST(InsideTheFloor, ABoxRisesOrRestsAndNeverFallsThrough) {
    for (const double depth : {1e-12, 1e-7, 0.1, 1.0}) {
        for (const double restitution : {0.0, 0.5, 0.9, 1.0}) {
            for (const double speed : {0.0, -30.0}) {
                SCOPED_TRACE("depth " + std::to_string(depth) + ", restitution " +
                             std::to_string(restitution) + ", speed " + std::to_string(speed));
                Simulation sim = accuracy::simulate(
                    {Law::Continuous, Precision::Double},
                    {{{0, 2 - depth}, {0, speed}, {4, 4}}, {{0, -5}, {0, 0}, {100, 10}, 1, true}},
                    {.step = {.gravity = {0, down}, .restitution = restitution}});
                for (int i = 0; i < 300; ++i) {
                    sim.step();
                    ASSERT_GE(position(sim, 0).y(), 2 - depth - 1e-9);
                }
                if (restitution < 1) {
                    EXPECT_EQ(velocity(sim, 0).y(), 0);
                }
            }
        }
    }
}

TEST(HeavyOnLight, ComesToRest) {
    for (const double mass : {50.0, 100.0, 1e5}) {
        for (const double restitution : {0.2, 0.5, 0.8, 0.9}) {
            SCOPED_TRACE(std::to_string(mass) + ", restitution " + std::to_string(restitution));
            Simulation sim =
                accuracy::simulate({Law::Continuous, Precision::Double},
                                   {{{0, 15}, {0, 0}, {4, 4}},
                                    {{0, 25}, {0, 0}, {10, 10}, mass},
                                    {{0, -5}, {0, 0}, {100, 10}, 1, true}},
                                   {.step = {.gravity = {0, down}, .restitution = restitution}});
            sim.run(1800);
            EXPECT_NEAR(position(sim, 0).y(), 2, 1e-8);
            EXPECT_NEAR(position(sim, 1).y(), 9, 1e-8);
            EXPECT_EQ(kineticEnergy(sim.world()), 0);
            EXPECT_EQ(sim.step().contacts, 0u);
        }
    }
}

}  // namespace
}  // namespace quadrille
