#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "reference/lattice_oracle.hpp"
#include "reference/oracle.hpp"
#include "support.hpp"

// Answers that are known in closed form: accuracy.md, sections 4 and 5.
namespace quadrille::reference {
namespace {

// ---- Galperin's billiard ("Playing pool with pi", 2003)

struct Billiard {
    int k;  ///< the mass ratio is 100^k
    std::size_t collisions;
};
void PrintTo(const Billiard& billiard, std::ostream* out) { *out << "k = " << billiard.k; }

class Galperin : public testing::TestWithParam<Billiard> {};
INSTANTIATE_TEST_SUITE_P(Reference, Galperin,
                         testing::Values(Billiard{0, 3}, Billiard{1, 31}, Billiard{2, 314},
                                         Billiard{3, 3141}, Billiard{4, 31415}));

TEST_P(Galperin, CountsTheDigitsOfPiAndLeavesWithTheExactVelocities) {
    const auto [k, collisions] = GetParam();
    const double ratio = std::pow(10, k);
    Oracle oracle(
        {{.position = {-0.5, 0}, .size = {1, 10}, .isStatic = true},
         {.position = {1, 0}, .size = {1, 1}},
         {.position = {4, 0}, .velocity = {-1, 0}, .size = {1, 1}, .mass = ratio * ratio}});
    double least = std::numeric_limits<double>::max();
    for (int slice = 1; slice <= 1000; ++slice) {
        oracle.runUntil(slice * 0.01);
        const auto state = oracle.state();
        const double x = state[1].position.x() - 0.5;  // the light block's gap to the wall
        const double v = state[1].velocity.x();
        const double heavyX = state[2].position.x() - 1.5;  // what it leaves to the heavy block
        const double heavyV = state[2].velocity.x();
        least = std::min(least, x);
        // The distance of the straight line in the unfolded wedge from its tip: 1/2 at the start.
        EXPECT_NEAR(std::abs(heavyX * v - x * heavyV), 0.5, 1e-8);
    }
    oracle.runUntil(100);
    const auto state = oracle.state();
    EXPECT_EQ(oracle.events().size(), collisions);
    EXPECT_GE(least, -1e-12);

    // accuracy.md, section 4: n block hits, theta = arctan(10^-k); the heavy block came with -1.
    const double n = std::ceil(double(collisions) / 2);
    const double angle = 2 * n * std::atan(1 / ratio);
    const Vec2 expected(-std::cos(angle), ratio * std::abs(std::sin(angle)));
    EXPECT_NEAR(state[2].velocity.x(), expected.x(), 1e-10);
    EXPECT_NEAR(std::abs(state[1].velocity.x()), expected.y(), 1e-7);
    if (k >= 1 && k <= 3) {
        const Vec2 table[] = {{.998857595563, .477860208206},
                              {.999998559563, .169731316195},
                              {.999999917461, .406299066323}};
        EXPECT_NEAR(state[2].velocity.x(), table[k - 1].x(), 1e-10);
        EXPECT_NEAR(std::abs(state[1].velocity.x()), table[k - 1].y(), 1e-8);
    }
    EXPECT_NEAR(energy(state) / (ratio * ratio / 2), 1, 1e-12);
}

// ---- pairs and chains (section 5)

TEST(KnownAnswer, CradleSendsOutAsManyAsComeIn) {
    for (int in = 1; in <= 5; ++in) {
        std::vector<Box> boxes;
        for (int i = 0; i < 6; ++i) boxes.push_back({.position = {10.0 + i, 0}});
        for (int i = 0; i < in; ++i) {
            boxes.insert(boxes.begin() + i, {.position = {-5.0 + i, 0}, .velocity = {2, 0}});
        }
        Oracle oracle(boxes);
        LatticeOracle exact(boxes);
        oracle.runUntil(30);
        exact.runUntil(30);
        const int count = int(boxes.size());
        for (int i = 0; i < count; ++i) {
            const Vec2 expected(i < count - in ? 0 : 2, 0);
            EXPECT_EQ(oracle.state()[std::size_t(i)].velocity, expected) << in << " in, box " << i;
            EXPECT_EQ(exact.state()[std::size_t(i)].velocity, expected) << in << " in, box " << i;
        }
    }
}

TEST(KnownAnswer, ChainOfMasses1248) {
    std::vector<Box> boxes;
    for (int i = 0; i < 4; ++i) {
        boxes.push_back({.position = {3.0 * i, 0}, .mass = std::pow(2, i)});
    }
    boxes[0].velocity = {1, 0};
    Oracle oracle(boxes);
    oracle.runUntil(100);
    const auto state = oracle.state();
    EXPECT_NEAR(state[0].velocity.x(), -1.0 / 3, 1e-15);
    EXPECT_NEAR(state[1].velocity.x(), -2.0 / 9, 1e-15);
    EXPECT_NEAR(state[2].velocity.x(), -4.0 / 27, 1e-15);
    EXPECT_NEAR(state[3].velocity.x(), 8.0 / 27, 1e-15);
    EXPECT_EQ(oracle.events().size(), 3u);
}

TEST(KnownAnswer, HeadOnWithAMassRatioOfAMillion) {
    Oracle oracle({{.position = {0, 0}, .velocity = {3, 0}},
                   {.position = {6, 0}, .velocity = {-2, 0}, .mass = 1e-6}});
    oracle.runUntil(10);
    EXPECT_NEAR(oracle.state()[0].velocity.x(), 3 - 1e-6 * 10 / (1 + 1e-6), 1e-14);
    EXPECT_NEAR(oracle.state()[0].velocity.x(), 2.99999000001, 1e-11);
    EXPECT_NEAR(oracle.state()[1].velocity.x(), 7.99999000001, 1e-11);
}

TEST(KnownAnswer, BulletHitsAThinWall) {
    const std::vector<Box> boxes{{.position = {0, 0}, .velocity = {6000, 0}},
                                 {.position = {50, 0}, .size = {0.1, 10}, .isStatic = true}};
    Oracle oracle(boxes);
    oracle.runUntil(1);
    ASSERT_EQ(oracle.events().size(), 1u);
    EXPECT_NEAR(oracle.events()[0].time, 989.0 / 120000, 1e-17);
    EXPECT_EQ(oracle.events()[0].j, -1);
    EXPECT_EQ(oracle.state()[0].velocity, Vec2(-6000, 0));
}

TEST(KnownAnswer, CornerToCornerBothReverse) {
    const std::vector<Box> boxes{{.position = {0, 0}, .velocity = {1, 1}},
                                 {.position = {5, 5}, .velocity = {-1, -1}}};
    Oracle oracle(boxes);
    LatticeOracle exact(boxes);
    oracle.runUntil(5);
    exact.runUntil(5);
    for (const auto& state : {oracle.state(), exact.state()}) {
        EXPECT_EQ(state[0].velocity, Vec2(-1, -1));
        EXPECT_EQ(state[1].velocity, Vec2(1, 1));
    }
    ASSERT_EQ(oracle.events().size(), 1u);
    ASSERT_EQ(exact.events().size(), 1u);
    EXPECT_EQ(oracle.events()[0].axis, 3);
    EXPECT_EQ(exact.events()[0].axis, 3);
    EXPECT_EQ(exact.events()[0].time, 2);
}

TEST(KnownAnswer, LevelEdgesPass) {
    const std::vector<Box> boxes{{.position = {0, 0}, .velocity = {1, 0}},
                                 {.position = {5, 1}, .velocity = {-1, 0}}};
    Oracle oracle(boxes);
    LatticeOracle exact(boxes);
    oracle.runUntil(10);
    exact.runUntil(10);
    EXPECT_TRUE(oracle.events().empty());
    EXPECT_TRUE(exact.events().empty());
}

TEST(KnownAnswer, FourOntoAFifthLeaveItAtRest) {
    const std::vector<Box> boxes{{.position = {-4, 0}, .velocity = {1, 0}},
                                 {.position = {4, 0}, .velocity = {-1, 0}},
                                 {.position = {0, -4}, .velocity = {0, 1}},
                                 {.position = {0, 4}, .velocity = {0, -1}},
                                 {.position = {0, 0}}};
    Oracle oracle(boxes);
    LatticeOracle exact(boxes);
    oracle.runUntil(10);
    exact.runUntil(10);
    for (const auto& state : {oracle.state(), exact.state()}) {
        EXPECT_EQ(state[4].position, Vec2(0, 0));
        EXPECT_EQ(state[4].velocity, Vec2(0, 0));
        for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(state[i].velocity, -boxes[i].velocity);
    }
}

TEST(KnownAnswer, FarFromTheOriginNothingIsLost) {
    for (const double x : {1e6, 1e9}) {
        Oracle oracle({{.position = {x, 0}, .velocity = {5, 0}, .size = {3, 3}}});
        for (int step = 1; step <= 600; ++step) oracle.runUntil(step / 60.0);
        EXPECT_EQ(oracle.state()[0].position.x(), x + 50);
    }
}

TEST(KnownAnswer, TinyAndHugeMeetInTime) {
    // Gap 10^4 - 500 - 0.0005, closing at 7 px/s.
    Oracle oracle({{.position = {0, 0}, .velocity = {3, 0}, .size = {1e3, 1e3}, .mass = 1e6},
                   {.position = {1e4, 499}, .velocity = {-4, 0}, .size = {1e-3, 1e-3}}});
    oracle.runUntil(2000);
    ASSERT_EQ(oracle.events().size(), 1u);
    EXPECT_NEAR(oracle.events()[0].time, (1e4 - 500.0005) / 7, 1e-12);
    EXPECT_EQ(oracle.events()[0].axis, 1);
}

TEST(KnownAnswer, RestitutionOfAHeadOnPair) {
    for (const double restitution : {0.0, 0.25, 1.0}) {
        Oracle oracle({{.position = {0, 0}, .velocity = {4, 1}, .mass = 1},
                       {.position = {6, 0}, .velocity = {0, 1}, .mass = 3}},
                      {0, 0}, restitution);
        oracle.runUntil(5);
        const auto state = oracle.state();
        EXPECT_NEAR(state[0].velocity.x(), 1 - 3 * restitution, 1e-14);
        EXPECT_NEAR(state[1].velocity.x(), 1 + restitution, 1e-14);
        EXPECT_EQ(state[0].velocity.y(), 1);
        EXPECT_EQ(oracle.events().size(), 1u);
    }
}

// ---- what is refused

TEST(Refusal, NamesTheBoxWithAnImpossibleValue) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Box& bad :
         {Box{.position = {nan, 0}}, Box{.velocity = {0, infinity}}, Box{.size = {0, 1}},
          Box{.size = {1, -1}}, Box{.mass = 0}, Box{.mass = -1}, Box{.mass = nan}}) {
        try {
            Oracle oracle({{.position = {9, 9}}, bad});
            FAIL() << "not refused";
        } catch (const std::invalid_argument& error) {
            EXPECT_NE(std::string(error.what()).find("box 1"), std::string::npos) << error.what();
        }
        EXPECT_THROW(LatticeOracle({{.position = {9, 9}}, bad}), std::invalid_argument);
    }
    EXPECT_THROW(Oracle({Box{}}, {nan, 0}), std::invalid_argument);
    EXPECT_THROW(Oracle({Box{}}, {0, 0}, 1.5), std::invalid_argument);
}

TEST(Refusal, OfTimesInThePast) {
    Oracle oracle({Box{}});
    oracle.runUntil(2);
    EXPECT_THROW(oracle.runUntil(1), std::invalid_argument);
    EXPECT_THROW(oracle.runUntil(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

}  // namespace
}  // namespace quadrille::reference
