#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <vector>

#include <quadrille/quadrille.hpp>

// The elastic rows of accuracy.md, sections 4 and 5, for the law `continuous`.

namespace quadrille {
namespace {

struct Body {
    Vec2 position, velocity;
    Vec2 size{1, 1};
    double mass = 1;
    bool isStatic = false;
};

Simulation simulate(const std::vector<Body>& bodies, double dt = 1.0 / 60,
                    Precision precision = Precision::Double) {
    World world({.size = {1000, 1000}});
    for (const Body& b : bodies) {
        world.add(world.create(), Transform{b.position}, BoxCollider{b.size},
                  PhysicsBody{b.velocity, b.mass, b.isStatic});
    }
    return Simulation(std::move(world), {.law = Law::Continuous, .precision = precision, .dt = dt});
}

Vec2 velocity(const Simulation& sim, std::uint32_t i) {
    return sim.world().get<PhysicsBody>(sim.world().at(i)).velocity;
}
Vec2 position(const Simulation& sim, std::uint32_t i) {
    return sim.world().get<Transform>(sim.world().at(i)).position;
}

TEST(ContinuousHardCases, CradlePassesAsManyOnAsComeIn) {
    for (int incoming = 1; incoming <= 3; ++incoming) {
        std::vector<Body> bodies;
        for (int i = 0; i < incoming; ++i) bodies.push_back({{-10.0 - i, 0}, {6, 0}});
        for (int i = 0; i < 6; ++i) bodies.push_back({{1.0 * i, 0}, {0, 0}});
        Simulation sim = simulate(bodies);
        sim.run(180);
        // From left to right: the last `incoming` move on, the rest stand.
        std::vector<std::pair<double, double>> row;
        for (std::uint32_t i = 0; i < bodies.size(); ++i) {
            row.emplace_back(position(sim, i).x(), velocity(sim, i).x());
        }
        std::sort(row.begin(), row.end());
        for (std::size_t i = 0; i < row.size(); ++i) {
            EXPECT_EQ(row[i].second, i + incoming >= row.size() ? 6 : 0)
                << incoming << " in, " << i;
        }
    }
}

TEST(ContinuousHardCases, MassesInARow) {
    Simulation sim = simulate({{{0, 0}, {1, 0}, {1, 1}, 1},
                               {{2, 0}, {0, 0}, {1, 1}, 2},
                               {{4, 0}, {0, 0}, {1, 1}, 4},
                               {{6, 0}, {0, 0}, {1, 1}, 8}});
    sim.run(60 * 20);
    EXPECT_NEAR(velocity(sim, 0).x(), -1.0 / 3, 1e-15);
    EXPECT_NEAR(velocity(sim, 1).x(), -2.0 / 9, 1e-15);
    EXPECT_NEAR(velocity(sim, 2).x(), -4.0 / 27, 1e-15);
    EXPECT_NEAR(velocity(sim, 3).x(), 8.0 / 27, 1e-15);
}

TEST(ContinuousHardCases, HeadOnWithAMassRatioOfAMillion) {
    Simulation sim = simulate({{{-5, 0}, {3, 0}}, {{5, 0}, {-2, 0}, {1, 1}, 1e-6}});
    sim.run(180);
    EXPECT_NEAR(velocity(sim, 0).x(), 2.99999000001, 1e-11);
    EXPECT_NEAR(velocity(sim, 1).x(), 7.99999000001, 1e-11);
}

TEST(ContinuousHardCases, BulletMeetsTheThinWall) {
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

TEST(ContinuousHardCases, CornerHitReversesBoth) {
    Simulation sim = simulate({{{-5, -5}, {1, 1}}, {{5, 5}, {-1, -1}}});
    sim.run(600);
    EXPECT_EQ(velocity(sim, 0), Vec2(-1, -1));
    EXPECT_EQ(velocity(sim, 1), Vec2(1, 1));
}

TEST(ContinuousHardCases, LevelEdgesPass) {
    Simulation sim = simulate({{{-5, 0}, {1, 0}}, {{5, 1}, {-1, 0}}});
    int contacts = 0;
    sim.onContact([&](const Contact&) { ++contacts; });
    sim.run(900);
    EXPECT_EQ(contacts, 0);
}

TEST(ContinuousHardCases, FourOntoAFifth) {
    // Smaller than the fifth: squares of its size would meet each other at its corners as well.
    const Vec2 small(0.5, 0.5);
    Simulation sim = simulate({{{0, 0}, {0, 0}},
                               {{-5, 0}, {1, 0}, small},
                               {{5, 0}, {-1, 0}, small},
                               {{0, -5}, {0, 1}, small},
                               {{0, 5}, {0, -1}, small}});
    sim.run(600);
    EXPECT_EQ(position(sim, 0), Vec2(0, 0));
    EXPECT_EQ(velocity(sim, 0), Vec2(0, 0));
    EXPECT_EQ(velocity(sim, 1), Vec2(-1, 0));
    EXPECT_EQ(velocity(sim, 4), Vec2(0, 1));
}

TEST(ContinuousHardCases, FarFromTheOrigin) {
    for (const double far : {1e6, 1e9}) {
        Simulation sim = simulate({{{far, far}, {5, 5}}});
        sim.run(600);
        EXPECT_EQ(position(sim, 0), Vec2(far + 50, far + 50));
    }
}

TEST(ContinuousHardCases, TinyMeetsHugeFromAfar) {
    Simulation sim = simulate({{{-2000, 0}, {10, 0}, {1e-3, 1e-3}}, {{0, 0}, {0, 0}, {1e3, 1e3}}});
    std::vector<double> times;
    sim.onContact([&](const Contact& c) { times.push_back(c.time); });
    sim.run(60 * 160);
    ASSERT_EQ(times.size(), 1u);
    EXPECT_NEAR(times[0], (2000 - 500 - 0.0005) / 10, 1e-11);
}

TEST(ContinuousHardCases, OverlapsKeepEnergyAndSeparate) {
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

// Galperin 2003; counts and final velocities of section 4. theta = atan(10^-k), n block hits.
TEST(ContinuousHardCases, GalperinsBilliard) {
    const int digits[] = {3, 31, 314, 3141, 31415};
    for (int k = 0; k <= 4; ++k) {
        const double ratio = std::pow(100.0, k);
        Simulation sim = simulate({{{0, 0}, {0, 0}, {20, 10}, 1, true},
                                   {{20, 0}, {0, 0}, {10, 10}, 1},
                                   {{60, 0}, {-1, 0}, {10, 10}, ratio}},
                                  0.25);
        int count = 0;
        double nearest = 1e9;
        sim.onContact([&](const Contact&) { ++count; });
        for (int i = 0; i < 2000; ++i) {
            sim.step();
            nearest = std::min(nearest, position(sim, 1).x());
        }
        SCOPED_TRACE("k = " + std::to_string(k));
        EXPECT_EQ(count, digits[k]);
        const double theta = std::atan(std::pow(10.0, -k));
        const double n = std::ceil(digits[k] / 2.0);
        EXPECT_NEAR(velocity(sim, 2).x(), -std::cos(2 * n * theta), 1e-9);
        EXPECT_NEAR(std::abs(velocity(sim, 1).x()),
                    std::pow(10.0, k) * std::abs(std::sin(2 * n * theta)), 1e-9);
        EXPECT_GE(nearest, 15 - 1e-9);
    }
}

TEST(ContinuousInvariants, SpeedsOfEqualMassesKeepTheirBits) {
    Scene scene = loadScene(QUADRILLE_SCENES_DIR "/balanced-scaled.toml", {.entities = 500});
    Simulation sim(std::move(scene.world), {.law = Law::Continuous});
    const auto speeds = [&] {
        const auto m = sim.world().bodies<double>().moving;
        std::vector<double> vx, vy;
        for (std::size_t i = 0; i < m.size(); ++i) {
            vx.push_back(std::abs(m.vx[i]));
            vy.push_back(std::abs(m.vy[i]));
        }
        std::sort(vx.begin(), vx.end());
        std::sort(vy.begin(), vy.end());
        return std::pair(vx, vy);
    };
    const auto before = speeds();
    sim.run(5000);
    EXPECT_EQ(speeds(), before);
    EXPECT_EQ(overlap(sim.world()).max, 0);
}

TEST(ContinuousInvariants, GoesOnFromASnapshotBitForBit) {
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
                                                      .dt = snapshot.step.dt});
        second.resumeAt(snapshot.stepsDone);
        second.run(250);
        EXPECT_EQ(stateHash(second.world()), stateHash(whole.world()));
    }
}

}  // namespace
}  // namespace quadrille
