#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <quadrille/names.hpp>
#include <quadrille/state_hash.hpp>

#include "collision/rules/contact_order.hpp"
#include "hard_cases/hard_case.hpp"

// Details of the law `continuous` that scenes at large hardly show: events at the ends of steps,
// overlaps where they begin, ties, rounding far from the origin.

namespace quadrille {
namespace {

using accuracy::Body;
using accuracy::Conditions;
using accuracy::position;
using accuracy::velocity;

constexpr accuracy::Setup exact{Law::Continuous, Precision::Double};

TEST(ContinuousEvents, AnEventAtTheEndOfAStepBelongsToIt) {
    for (const double dt : {1.0 / 60, 1.0 / 16, 1.0 / 4, 1.0}) {
        SCOPED_TRACE("dt " + std::to_string(dt));
        // Both pairs meet at t = 1.
        Simulation sim = accuracy::simulate(exact,
                                            {{{-2.5, 0}, {2, 0}},
                                             {{2.5, 0}, {-2, 0}},
                                             {{0, 12.5}, {0, -2}},
                                             {{0, 9}, {0, 0}, {20, 2}, 1, true}},
                                            {.step = {.dt = dt}});
        const accuracy::ContactLog log(sim);
        while (sim.time() < 1) sim.step();
        ASSERT_EQ(sim.time(), 1);
        EXPECT_EQ(log.collisions().size(), 2u);
        EXPECT_EQ(velocity(sim, 0), Vec2(-2, 0));
        EXPECT_EQ(velocity(sim, 1), Vec2(2, 0));
        EXPECT_EQ(velocity(sim, 2), Vec2(0, 2));
        EXPECT_EQ(position(sim, 2), Vec2(0, 10.5));
    }
}

TEST(ContinuousEvents, BodiesThatOverlapAndGoTogetherDoNotCollide) {
    Simulation sim = accuracy::simulate(exact, {{{0, 0}, {3, 1}}, {{0.5, 0.25}, {3, 1}}});
    std::size_t contacts = 0;
    sim.onContact([&](const Contact&) { ++contacts; });
    sim.run(60);
    EXPECT_EQ(contacts, 0u);
    EXPECT_EQ(position(sim, 0), Vec2(3, 1));
    EXPECT_EQ(position(sim, 1), Vec2(3.5, 1.25));
}

TEST(ContinuousEvents, AnOverlapTurnsBodiesWhereTheyAre) {
    Simulation sim = accuracy::simulate(exact,
                                        {{{0, 0}, {1, 0}, {4, 4}},
                                         {{3, 1}, {-2, 0}, {4, 4}},
                                         {{0, 101.5}, {0, -2}, {4, 4}},
                                         {{0, 98}, {0, 0}, {20, 4}, 1, true}},
                                        {.step = {.dt = 1.0 / 4}});
    sim.step();
    EXPECT_EQ(position(sim, 0), Vec2(-2.0 / 4, 0));
    EXPECT_EQ(position(sim, 1), Vec2(3 + 1.0 / 4, 1));
    EXPECT_EQ(position(sim, 2), Vec2(0, 101.5 + 2.0 / 4));
}

TEST(ContinuousEvents, ABodyWedgedBetweenWallsNeitherLoopsNorGainsEnergy) {
    const auto state = [](double dt) {
        Simulation sim = accuracy::simulate(exact,
                                            {{{0.25, 0}, {1, 2}, {4, 4}},
                                             {{-6, 0}, {0, 0}, {9, 40}, 1, true},
                                             {{6, 0}, {0, 0}, {9, 40}, 1, true}},
                                            {.step = {.dt = dt}});
        const double energy = kineticEnergy(sim.world());
        while (sim.time() < 2) sim.step();
        EXPECT_EQ(kineticEnergy(sim.world()), energy);
        EXPECT_EQ(position(sim, 0).y(), 4);
        EXPECT_TRUE(position(sim, 0).allFinite());
        return stateHash(sim.world());
    };
    EXPECT_EQ(state(1.0 / 60), state(1.0 / 16));
    EXPECT_EQ(state(1.0 / 60), state(1.0 / 4));
}

// A heavy block makes light bodies many times as fast as the others: all get wider bounds, for a
// shorter time.
TEST(ContinuousEvents, AHeavyBlockAmongSlowBodiesMakesNoMoreCellsThanTheyNeed) {
    std::vector<Body> bodies;
    for (int i = 0; i < 900; ++i) {
        const double turn = 0.7 * i;
        bodies.push_back({{20.0 * (i % 30), 20.0 * (i / 30)},
                          {15 * std::cos(turn), 15 * std::sin(turn)},
                          {10, 10}});
    }
    bodies.push_back({{-100, 300}, {400, -200}, {110, 110}, 500});
    for (const double side : {-1.0, 1.0}) {
        bodies.push_back({{290 + side * 520, 290}, {0, 0}, {20, 2000}, 1, true});
        bodies.push_back({{290, 290 + side * 520}, {0, 0}, {2000, 20}, 1, true});
    }
    Simulation sim = accuracy::simulate(exact, bodies);
    std::uint64_t pairs = 0, collisions = 0;
    for (int i = 0; i < 60; ++i) {
        const StepReport report = sim.step();
        pairs += report.pairsTested;
        collisions += report.collisions;
        ASSERT_LT(sim.cells().size(), 2 * bodies.size()) << "step " << i;
    }
    EXPECT_GT(collisions, 1000u);
    EXPECT_LT(pairs, 60 * 40 * bodies.size());
}

TEST(ContinuousEvents, TiesGoByTheHashOfThePair) {
    constexpr int pairs = 40;
    std::vector<Body> bodies;
    for (int i = 0; i < pairs; ++i) {
        bodies.push_back({{-2.5, 10.0 * i}, {2, 0}});
        bodies.push_back({{2.5, 10.0 * i}, {-2, 0}});
    }
    Simulation sim = accuracy::simulate(exact, bodies);
    const accuracy::ContactLog log(sim);
    sim.run(90);
    ASSERT_EQ(log.collisions().size(), std::size_t{pairs});
    std::uint32_t last = 0;
    bool rowsRise = true;
    for (std::size_t i = 0; i < log.collisions().size(); ++i) {
        const Contact& c = log.collisions()[i];
        EXPECT_EQ(c.time, 1);
        const std::uint32_t priority = pairPriority(c.a.index, c.b.index);
        EXPECT_GE(priority, last);
        last = priority;
        if (i > 0) rowsRise = rowsRise && log.collisions()[i - 1].numberA < c.numberA;
    }
    EXPECT_FALSE(rowsRise) << "this scene would not show the difference";
}

/// Slow crowds far from the origin, where rounding is more than a step's motion.
TEST(ContinuousEvents, FarFromTheOriginEveryPartitionerGivesTheSameState) {
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            SCOPED_TRACE(std::string(name(precision)) + ", seed " + std::to_string(seed));
            const double far = precision == Precision::Double ? 1e13 : 1e5;
            const auto hash = [&](const PartitionerConfig& partitioner) {
                Random random(seed);
                std::vector<Body> bodies;
                for (int i = 0; i < 100; ++i) {
                    const Vec2 place(far + 3.5 * (i % 10), far + 3.5 * (i / 10));
                    const double vx = random.uniform(-0.1, 0.1);
                    bodies.push_back({place, {vx, random.uniform(-0.1, 0.1)}, {3, 3}});
                }
                Simulation sim = accuracy::simulate(
                    {Law::Continuous, precision}, bodies,
                    {.step = {.dt = 1.0 / 4}, .world = {2 * far + 80, 2 * far + 80}});
                sim.setPartitioner(partitioner);
                sim.run(200);
                return stateHash(sim.world());
            };
            const std::uint64_t expected = hash(BruteForce{});
            EXPECT_EQ(hash(Quadtree{15, 4}), expected);
            EXPECT_EQ(hash(SemiStaticQuadtree{15, 4}), expected);
            EXPECT_EQ(hash(SemiStaticQuadtree{15, 4, SemiStaticQuadtree::Skin{0.5}}), expected);
        }
    }
}

}  // namespace
}  // namespace quadrille
