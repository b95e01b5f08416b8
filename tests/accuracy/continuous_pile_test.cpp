#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include <quadrille/quadrille.hpp>

#include "hard_cases/hard_case.hpp"

// The law `continuous` where bodies come to rest on each other.

namespace quadrille {
namespace {

using accuracy::Body;
using accuracy::position;
using accuracy::velocity;

Simulation pile(const SimulationConfig& asked) {
    Scene scene = loadScene(std::filesystem::path(QUADRILLE_SCENES_DIR) / "pile.toml");
    SimulationConfig config = asked;
    config.law = Law::Continuous;
    config.step.gravity = scene.step.gravity;
    config.step.restitution = scene.step.restitution;
    return Simulation(std::move(scene.world), config);
}

Simulation drop(const std::vector<Body>& bodies, double restitution) {
    return accuracy::simulate({Law::Continuous, Precision::Double}, bodies,
                              {.step = {.gravity = {0, -200}, .restitution = restitution}});
}

const Body ground{{0, -5}, {0, 0}, {100, 10}, 1, true};

TEST(ContinuousPile, ComesDownWithoutOverlapOrGainOfEnergy) {
    Simulation sim = pile({});
    const Vec2 gravity = sim.config().step.gravity;
    double energy = totalEnergy(sim.world(), gravity);
    for (int i = 0; i < 30; ++i) {
        sim.run(20);
        const double now = totalEnergy(sim.world(), gravity);
        EXPECT_LE(now, energy + 1e-9 * std::abs(energy)) << i;
        energy = now;
        EXPECT_LT(overlap(sim.world()).max, 1e-10) << i;
    }
    EXPECT_EQ(escaped(sim.world()), 0u);
    // Five layers of boxes of 8 px, as deep as they lie: most have nothing left to fall.
    int resting = 0;
    sim.world().each<PhysicsBody>([&](Entity, const PhysicsBody& body) {
        resting += !body.isStatic && body.velocity.y() == 0;
    });
    EXPECT_GT(resting, 800);
}

TEST(ContinuousPile, SameBitsWhateverTheStepAndThePartitioner) {
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        Simulation sim = pile({.precision = precision});
        sim.run(180);
        const std::uint64_t hash = stateHash(sim.world());
        for (const int perSecond : {16, 240}) {
            Simulation other = pile({.precision = precision, .step = {.dt = 1.0 / perSecond}});
            other.run(static_cast<std::uint64_t>(3 * perSecond));
            EXPECT_EQ(stateHash(other.world()), hash) << perSecond;
        }
        for (const PartitionerConfig& partitioner :
             std::vector<PartitionerConfig>{StaticGrid{}, Quadtree{}}) {
            Simulation other = pile({.partitioner = partitioner, .precision = precision});
            other.run(180);
            EXPECT_EQ(stateHash(other.world()), hash) << name(partitioner);
        }
    }
}

TEST(ContinuousPile, GoesOnFromASnapshotBitForBit) {
    const auto file = std::filesystem::temp_directory_path() / "quadrille_pile_test.snapshot";
    Simulation sim = pile({});
    sim.run(100);
    saveSnapshot(file, sim, "pile", 1);
    sim.run(100);
    Snapshot snapshot = loadSnapshot(file);
    std::filesystem::remove(file);
    Simulation resumed(std::move(snapshot.world), sim.config());
    resumed.resumeAt(snapshot.stepsDone);
    resumed.run(100);
    EXPECT_EQ(stateHash(resumed.world()), stateHash(sim.world()));
}

TEST(ContinuousPile, SlidesOffWhatItRestsOnAndFalls) {
    // Its left edge passes the right edge of the ground after (50 + 4) / 27 = 2 s.
    Simulation sim = drop({ground, {{0, 4}, {27, 0}, {8, 8}}}, 0.5);
    sim.run(120);
    EXPECT_EQ(velocity(sim, 1).y(), 0);
    EXPECT_EQ(position(sim, 1).y(), 4);
    sim.run(30);
    EXPECT_NEAR(velocity(sim, 1).y(), -200 * 0.5, 1e-9);
    EXPECT_NEAR(position(sim, 1).y(), 4 - 100 * 0.25, 1e-9);
    EXPECT_EQ(velocity(sim, 1).x(), 27);
}

TEST(ContinuousPile, SlidesAcrossTheSeamsOfItsFloor) {
    std::vector<Body> bodies;
    for (int i = 0; i < 10; ++i) bodies.push_back({{10.0 * i, -5}, {0, 0}, {10, 10}, 1, true});
    bodies.push_back({{0, 4}, {30, 0}, {8, 8}});
    Simulation sim = drop(bodies, 1);
    sim.run(180);
    EXPECT_EQ(velocity(sim, 10), Vec2(30, 0));
    EXPECT_EQ(position(sim, 10), Vec2(90, 4));
}

TEST(ContinuousPile, FallsWhenItsSupportIsTaken) {
    for (const double restitution : {0.0, 0.5, 1.0}) {
        Simulation sim = drop({ground,
                               {{0, 4}, {0, 0}, {8, 8}},
                               {{0, 12}, {0, 0}, {8, 8}},
                               {{0, 20}, {0, 0}, {8, 8}}},
                              restitution);
        sim.run(60);
        EXPECT_EQ(position(sim, 3).y(), 20) << restitution;
        sim.world().destroy(sim.world().at(1));
        sim.run(12);
        // Both fall together: 0.2 s at 200 px/s^2 make 4 px.
        EXPECT_NEAR(position(sim, 2).y(), 8, 1e-9) << restitution;
        EXPECT_NEAR(position(sim, 3).y(), 16, 1e-9) << restitution;
        EXPECT_NEAR(velocity(sim, 3).y(), -40, 1e-9) << restitution;
    }
}

// The support stops at a wall at the instant at which the upper box leaves its edge. Whichever of
// the two events comes first, which the entities' numbers decide, the upper box must notice.
TEST(ContinuousPile, FallsWhenItsRestEndsAtTheInstantOfAnotherEvent) {
    constexpr int copies = 12;
    std::vector<Body> bodies;
    for (int i = 0; i < copies; ++i) {
        const double x = 40.0 * i;
        bodies.push_back({{x, 2}, {2, 0}, {4, 4}});  // slides to x + 4
        bodies.push_back({{x, 6}, {0, 0}, {4, 4}});  // on top of it
        bodies.push_back({{x + 8, 2}, {0, 0}, {4, 4}, 1, true});
    }
    bodies.push_back({{200, -5}, {0, 0}, {1000, 10}, 1, true});
    Simulation sim = drop(bodies, 0);
    sim.run(150);
    for (std::size_t i = 0; i < copies; ++i) {
        SCOPED_TRACE("copy " + std::to_string(i));
        const double x = 40.0 * static_cast<double>(i);
        EXPECT_EQ(position(sim, 3 * i), Vec2(x + 4, 2));
        EXPECT_EQ(position(sim, 3 * i + 1).x(), x);
        EXPECT_NEAR(position(sim, 3 * i + 1).y(), 2, 1e-9);
    }
}

TEST(ContinuousPile, ARowAgainstAWallIsStruckAsOne) {
    // Restitution 1/2: the striker comes back at half its speed, the row cannot give way.
    std::vector<Body> bodies{{{55, 0}, {0, 0}, {10, 100}, 1, true}};
    for (int i = 0; i < 20; ++i) bodies.push_back({{49.5 - i, 0}, {0, 0}});
    bodies.push_back({{0, 0}, {40, 0}});
    Simulation sim = accuracy::simulate({Law::Continuous, Precision::Double}, bodies,
                                        {.step = {.restitution = 0.5}});
    std::uint64_t contacts = 0;
    sim.onStep([&](const World&, const StepReport& report) { contacts += report.contacts; });
    sim.run(120);
    EXPECT_EQ(velocity(sim, 21), Vec2(-20, 0));
    for (std::uint32_t i = 1; i <= 20; ++i) EXPECT_EQ(velocity(sim, i), Vec2(0, 0)) << i;
    EXPECT_EQ(contacts, 1u);
}

TEST(ContinuousPile, AFreeRowIsStruckAsOne) {
    std::vector<Body> bodies;
    for (int i = 0; i < 5; ++i) bodies.push_back({{1.0 * i, 0}, {0, 0}});
    bodies.push_back({{-10, 0}, {6, 0}});
    Simulation sim = accuracy::simulate({Law::Continuous, Precision::Double}, bodies,
                                        {.step = {.restitution = 0.5}});
    sim.run(240);
    // m v = 6 and v_row - v_striker = 3, with masses 5 and 1.
    for (std::uint32_t i = 0; i < 5; ++i) EXPECT_NEAR(velocity(sim, i).x(), 1.5, 1e-14) << i;
    EXPECT_NEAR(velocity(sim, 5).x(), -1.5, 1e-14);
    EXPECT_NEAR(momentum(sim.world()).x(), 6, 1e-13);
}

}  // namespace
}  // namespace quadrille
