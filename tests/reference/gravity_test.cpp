#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

#include "reference/oracle.hpp"
#include "support.hpp"

// Gravity, rest and restitution: accuracy.md, section 5.
namespace quadrille::reference {
namespace {

constexpr double g = 100;  // px/s^2
const Vec2 down{0, -g};
const Box ground{.position = {0, -5}, .size = {100, 10}, .isStatic = true};  // top edge at y = 0

/// Kinetic and potential energy.
double totalEnergy(const std::vector<Box>& boxes) {
    double sum = energy(boxes);
    for (const Box& box : boxes) {
        if (!box.isStatic) sum += box.mass * g * box.position.y();
    }
    return sum;
}

TEST(Gravity, BounceKeepsPeriodAndEnergyFor60Seconds) {
    const double h = 8;
    Oracle oracle({ground, {.position = {0, 0.5 + h}}}, down);
    const double before = totalEnergy(oracle.state());
    for (int slice = 1; slice <= 600; ++slice) {
        oracle.runUntil(slice * 0.1);
        EXPECT_NEAR(totalEnergy(oracle.state()) / before, 1, 1e-11);
    }
    const double period = 2 * std::sqrt(2 * h / g);
    const auto& events = oracle.events();
    ASSERT_EQ(events.size(), std::size_t(60 / period + 0.5));
    for (std::size_t n = 0; n < events.size(); ++n) {
        EXPECT_NEAR(events[n].time, (double(n) + 0.5) * period, 1e-10);
    }
}

TEST(Gravity, BoxAtRestStays) {
    for (const double restitution : {0.0, 0.5, 1.0}) {
        // At 0.3 the edges meet up to rounding only.
        for (const double side : {1.0, 0.3}) {
            Oracle oracle({ground, {.position = {3, side / 2}, .size = {side, side}}}, down,
                          restitution);
            oracle.runUntil(60);
            EXPECT_NEAR(oracle.state()[1].position.y(), side / 2, 1e-12);
            EXPECT_EQ(oracle.state()[1].velocity, Vec2(0, 0));
            EXPECT_TRUE(oracle.events().empty());
        }
    }
}

TEST(Gravity, StackAtRestStays) {
    std::vector<Box> boxes{ground};
    for (int i = 0; i < 5; ++i) boxes.push_back({.position = {0.125 * i, 0.5 + i}});
    for (const double restitution : {0.5, 1.0}) {
        Oracle oracle(boxes, down, restitution);
        oracle.runUntil(60);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            EXPECT_NEAR((oracle.state()[i].position - boxes[i].position).norm(), 0, 1e-12);
        }
    }
}

TEST(Gravity, RestitutionBelowOneComesToRestInTheKnownTime) {
    // Bounces of heights h e^2n: sum of the times = sqrt(2h/g) (1 + e)/(1 - e).
    const double h = 2;
    const double e = 0.5;
    Oracle oracle({ground, {.position = {0, 0.5 + h}}}, down, e);
    oracle.runUntil(10);
    const double end = std::sqrt(2 * h / g) * (1 + e) / (1 - e);
    // What bounces no higher than the touching distance, 1e-9 px, rests: at 1e-4 px/s, and so
    // (1 + e)/(1 - e) 1e-4 / g before its end.
    EXPECT_NEAR(oracle.events().back().time, end, 1e-4);
    EXPECT_EQ(oracle.state()[1].velocity, Vec2(0, 0));
    EXPECT_NEAR(oracle.state()[1].position.y(), 0.5, 1e-12);
}

TEST(Gravity, WhatFallsOnAStackAtRestReboundsAsFromTheGround) {
    std::vector<Box> boxes{ground};
    for (int i = 0; i < 3; ++i)
        boxes.push_back({.position = {0.125 * i, 0.5 + i}, .mass = 1.0 + i});
    boxes.push_back({.position = {0.25, 4.5}, .velocity = {0, -3}, .mass = 1000});
    Oracle oracle(boxes, down, 0.5);
    const double fall = (std::sqrt(9 + 2 * g) - 3) / g;  // of 1 px
    oracle.runUntil(fall + 1e-6);
    EXPECT_NEAR(oracle.state()[4].velocity.y(), 0.5 * std::sqrt(9 + 2 * g), 1e-3);
    for (std::size_t i = 1; i < 4; ++i) {
        EXPECT_EQ(oracle.state()[i].velocity, Vec2(0, 0));
        EXPECT_NEAR((oracle.state()[i].position - boxes[i].position).norm(), 0, 1e-9);
    }
    EXPECT_EQ(oracle.choices().pushed, 1u);
}

TEST(Gravity, WhatRestsIsNotHeldAgainstAPushFromBelow) {
    // A box over the edge of a table; another comes up past the table and hits it at 30 px/s.
    const Box table{.position = {0, -0.5}, .size = {10, 1}, .isStatic = true};
    Oracle oracle({table, {.position = {5, 0.5}}, {.position = {5.8, -4}, .velocity = {0, 40}}},
                  down, 0.5);
    oracle.runUntil(0.1 + 1e-6);
    EXPECT_NEAR(oracle.state()[1].velocity.y(), 22.5, 1e-3);
    EXPECT_NEAR(oracle.state()[2].velocity.y(), 7.5, 1e-3);
    EXPECT_EQ(oracle.choices().pushed, 0u);
}

TEST(Restitution, BoxesThatTouchAndMoveTogetherCollideAsOne) {
    // Masses 1 and 3 behind each other at 2 px/s, against one of mass 4 that stands.
    const std::vector<Box> boxes{{.position = {-4, 0}, .velocity = {2, 0}},
                                 {.position = {-3, 0}, .velocity = {2, 0}, .mass = 3},
                                 {.position = {0, 0}, .mass = 4}};
    for (const double e : {0.0, 0.5}) {
        Oracle oracle(boxes, {0, 0}, e);
        oracle.runUntil(1.5);
        EXPECT_NEAR(oracle.state()[0].velocity.x(), 1 - e, 1e-12);
        EXPECT_NEAR(oracle.state()[1].velocity.x(), 1 - e, 1e-12);
        EXPECT_NEAR(oracle.state()[2].velocity.x(), 1 + e, 1e-12);
        EXPECT_EQ(oracle.events().size(), 1u);
    }
}

TEST(Restitution, ARowAgainstAWallIsHeld) {
    const std::vector<Box> boxes{{.position = {3, 0}, .size = {1, 10}, .isStatic = true},
                                 {.position = {2, 0}},
                                 {.position = {1, 0}},
                                 {.position = {-2, 0}, .velocity = {4, 0}, .mass = 7}};
    Oracle oracle(boxes, {0, 0}, 0.25);
    oracle.runUntil(1);
    EXPECT_EQ(oracle.state()[1].velocity, Vec2(0, 0));
    EXPECT_EQ(oracle.state()[2].velocity, Vec2(0, 0));
    EXPECT_NEAR(oracle.state()[3].velocity.x(), -1, 1e-12);
}

TEST(Gravity, RestingBoxSlidesOffItsSupportAndFalls) {
    const Box table{.position = {0, -0.5}, .size = {10, 1}, .isStatic = true};
    Oracle oracle({table, {.position = {0, 0.5}, .velocity = {1, 0}}}, down);
    const double edge = 5.5;  // s, when its left side passes the right side of the table
    oracle.runUntil(edge);
    EXPECT_NEAR(oracle.state()[1].position.y(), 0.5, 1e-12);
    oracle.runUntil(edge + 1);
    EXPECT_NEAR(oracle.state()[1].position.y(), 0.5 - g / 2, 1e-9);
    EXPECT_NEAR(oracle.state()[1].position.x(), edge + 1, 1e-12);
}

TEST(Gravity, BoxOnAMovedSupportIsHeldOrFalls) {
    // The lower box is shot away from under the upper one.
    const std::vector<Box> boxes{ground,
                                 {.position = {0, 0.5}},
                                 {.position = {0, 1.5}},
                                 {.position = {-10, 0.5}, .velocity = {20, 0}}};
    Oracle oracle(boxes, down, 1);
    oracle.runUntil(0.4);  // it is hit at 0.45
    EXPECT_NEAR(oracle.state()[2].position.y(), 1.5, 1e-12);
    oracle.runUntil(0.47);  // still above it
    EXPECT_NEAR(oracle.state()[2].position.y(), 1.5, 1e-12);
    oracle.runUntil(0.55);  // alone since 0.5
    EXPECT_NEAR(oracle.state()[2].position.y(), 1.5 - g * 0.05 * 0.05 / 2, 1e-9);
}

TEST(Gravity, ThrownPairMovesAsIfFree) {
    // Seen from the centre of mass there is no gravity between moving boxes.
    Oracle oracle({{.position = {0, 0}, .velocity = {3, 10}, .mass = 2},
                   {.position = {5, 0}, .velocity = {-1, 10}}},
                  down);
    oracle.runUntil(2);
    ASSERT_EQ(oracle.events().size(), 1u);
    EXPECT_NEAR(oracle.events()[0].time, 1, 1e-14);
    const auto state = oracle.state();
    EXPECT_NEAR(state[0].velocity.x(), 1.0 / 3, 1e-14);
    EXPECT_NEAR(state[1].velocity.x(), 13.0 / 3, 1e-14);
    EXPECT_NEAR(state[0].position.y(), 10 * 2 - g * 4 / 2, 1e-12);
}

TEST(Gravity, InABoxEnergyIsKeptAndNothingOverlaps) {
    const std::vector<Box> boxes = mixture(60, 3);
    Oracle oracle(boxes, down);
    const double before = totalEnergy(boxes);
    double scale = energy(boxes);
    for (const Box& box : movingOf(boxes)) scale += box.mass * g * 80;
    for (int slice = 1; slice <= 20; ++slice) {
        oracle.runUntil(slice * 0.5);
        EXPECT_LE(largestOverlap(oracle.state()), 1e-9);
        EXPECT_NEAR((totalEnergy(oracle.state()) - before) / scale, 0, 1e-10);
    }
}

TEST(Gravity, PileWithRestitutionBelowOneComesToRest) {
    std::vector<Box> boxes = mixture(40, 5);
    for (Box& box : boxes) box.velocity.setZero();
    Oracle oracle(boxes, down, 0.5);
    oracle.runUntil(60);
    EXPECT_GT(oracle.events().size(), 100u);
    EXPECT_LT(totalEnergy(oracle.state()), totalEnergy(boxes));
    EXPECT_LE(energy(oracle.state()), 1e-9);
    EXPECT_LE(largestOverlap(oracle.state()), 1e-6);
}

}  // namespace
}  // namespace quadrille::reference
