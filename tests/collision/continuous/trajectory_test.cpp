#include "collision/rules/trajectory.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include <quadrille/random.hpp>

namespace quadrille {
namespace {

bool isEmpty(const Interval& i) { return !(i.enter < i.leave); }

/// Intervals of which only the first counts.
Intervals<1> during(double enter, double leave) { return {{{enter, leave}}}; }

constexpr Intervals<1> always{{{-never, never}}};

// ---- straight

TEST(Trajectory, AStraightDistanceIsWithinReachBetweenTwoTimes) {
    const Interval approaching = within(10, -2, 1, 4);
    EXPECT_EQ(approaching.enter, 4);
    EXPECT_EQ(approaching.leave, 8);
    const Interval fromBelow = within(-10, 2, 1, 4);
    EXPECT_EQ(fromBelow.enter, 4);
    EXPECT_EQ(fromBelow.leave, 8);
    const Interval parting = within(10, 2, 1, 4);
    EXPECT_EQ(parting.enter, -6);
    EXPECT_EQ(parting.leave, -2);
}

TEST(Trajectory, ADistanceThatDoesNotChangeIsWithinReachAlwaysOrNever) {
    const Interval inside = within(3, 0, 1, 4);
    EXPECT_EQ(inside.enter, -never);
    EXPECT_EQ(inside.leave, never);
    EXPECT_TRUE(isEmpty(within(5, 0, 1, 4)));
}

TEST(Trajectory, LevelEdgesPassEachOther) {
    EXPECT_TRUE(isEmpty(within(4, 0, 1, 4)));
    EXPECT_TRUE(isEmpty(within(-4, 0, 1, 4)));
    EXPECT_FALSE(isEmpty(within(std::nextafter(4, 0), 0, 1, 4)));
}

TEST(Trajectory, TheDistanceDoesNotDependOnWhichBodyIsAsked) {
    Random random(71);
    for (int i = 0; i < 10000; ++i) {
        SCOPED_TRACE(i);
        const auto path = [&] {
            return StraightPath{random.uniform(-50, 50), random.uniform(-9, 9),
                                random.uniform(0, 1)};
        };
        const StraightPath a = path();
        const StraightPath b = path();
        const double reach = random.uniform(0, 20);
        const Interval p = approach(a, b, laterAnchor(a, b), reach, 0).at[0];
        const Interval q = approach(b, a, laterAnchor(a, b), reach, 0).at[0];
        ASSERT_EQ(p.enter, q.enter);
        ASSERT_EQ(p.leave, q.leave);
        // And it is the distance that the paths have.
        for (const double t : {p.enter, p.leave}) {
            ASSERT_NEAR(std::abs(b.position(t) - a.position(t)), reach, 1e-9 * (1 + std::abs(t)));
        }
    }
}

TEST(Trajectory, TimesDoNotDependOnWhereAnchorsLie) {
    Random random(72);
    for (int i = 0; i < 10000; ++i) {
        const auto distance = static_cast<double>(random.integer(1, 1000));
        const auto u = static_cast<double>(random.integer(1, 1000));
        const auto t0 = static_cast<double>(random.integer(-1000, 1000)) / 8;
        ASSERT_EQ(timeAfter(t0, distance - t0 * u, u), distance / u);
    }
    EXPECT_EQ(timeAfter(1, 1e300, 1e-300), std::numeric_limits<double>::infinity())
        << "what overflows is never";
}

// ---- falling

TEST(Trajectory, RootsOfAParabola) {
    double low = 0;
    double high = 0;
    ASSERT_TRUE(roots(3, -4, 2, low, high));  // (s - 1) (s - 3)
    EXPECT_EQ(low, 1);
    EXPECT_EQ(high, 3);
    ASSERT_TRUE(roots(3, 4, 2, low, high));
    EXPECT_EQ(low, -3);
    EXPECT_EQ(high, -1);
    ASSERT_TRUE(roots(-4, 0, 2, low, high));
    EXPECT_EQ(low, -2);
    EXPECT_EQ(high, 2);
}

TEST(Trajectory, AParabolaThatOnlyTouchesHasNoRoots) {
    double low = 0;
    double high = 0;
    EXPECT_FALSE(roots(1, -2, 2, low, high));  // (s - 1)^2
    EXPECT_FALSE(roots(2, -2, 2, low, high));
    EXPECT_FALSE(roots(std::nan(""), -2, 2, low, high));
}

TEST(Trajectory, TheSmallRootIsNotLostToCancellation) {
    double low = 0;
    double high = 0;
    ASSERT_TRUE(roots(1, -1e9, 2, low, high));
    EXPECT_NEAR(low, 1e-9, 1e-24);
    EXPECT_NEAR(high, 1e9, 1e-6);
    ASSERT_TRUE(roots(1, 1e9, 2, low, high));
    EXPECT_NEAR(high, -1e-9, 1e-24);
}

TEST(Trajectory, AParabolaMayPassThroughTwice) {
    // Thrown up from 5 below, over to 20 above and down again: d = -5 + 20 s - 8 s^2 / 2.
    const Intervals<2> i = within(-5, 20, -8, 100, 4);
    ASSERT_FALSE(isEmpty(i.at[0]));
    ASSERT_FALSE(isEmpty(i.at[1]));
    EXPECT_LT(i.at[0].leave, i.at[1].enter);
    const auto d = [](double t) { return -5 + 20 * (t - 100) - 4 * (t - 100) * (t - 100); };
    EXPECT_NEAR(d(i.at[0].enter), -4, 1e-9);
    EXPECT_NEAR(d(i.at[0].leave), 4, 1e-9);
    EXPECT_NEAR(d(i.at[1].enter), 4, 1e-9);
    EXPECT_NEAR(d(i.at[1].leave), -4, 1e-9);
    EXPECT_TRUE(touches(i, 100, 101));
    EXPECT_FALSE(touches(i, 101, 103));
    EXPECT_TRUE(touches(i, 104, 106));
    EXPECT_EQ(insideUntil(i, 102), -never);
    EXPECT_EQ(insideUntil(i, 100.2), i.at[0].leave);
}

TEST(Trajectory, AParabolaMayTurnWithin) {
    const Intervals<2> i = within(-5, 6, -8, 0, 4);  // turns at -2.75
    EXPECT_FALSE(isEmpty(i.at[0]));
    EXPECT_TRUE(isEmpty(i.at[1]));
}

TEST(Trajectory, AParabolaMayTurnBefore) {
    const Intervals<2> i = within(-5, 2, -8, 0, 4);  // turns at -4.75
    EXPECT_TRUE(isEmpty(i.at[0]));
    EXPECT_TRUE(isEmpty(i.at[1]));
}

TEST(Trajectory, FallingTogetherIsStraight) {
    const FallingPath a{0, 1, 0, 10};
    const FallingPath b{8, -1, 0, 10};
    const Intervals<2> i = approach(a, b, 0, 4, 0);
    EXPECT_DOUBLE_EQ(i.at[0].enter, 2);
    EXPECT_DOUBLE_EQ(i.at[0].leave, 6);
    EXPECT_TRUE(isEmpty(i.at[1]));
}

TEST(Trajectory, WhatSlidesAlongAFloorTouchesAndIsNotWithin) {
    const FallingPath floor{0, 0, 0, 0};
    const double rounded = std::nextafter(4, 0);
    EXPECT_FALSE(isEmpty(approach(floor, {rounded, 0, 0, 0}, 0, 4, 0).at[0]));
    EXPECT_TRUE(isEmpty(approach(floor, {rounded, 0, 0, 0}, 0, 4, 1e-12).at[0]));
    EXPECT_FALSE(isEmpty(approach(floor, {rounded, -1e-9, 0, 0}, 0, 4, 1e-12).at[0]));
}

// ---- both axes

TEST(Trajectory, BoxesMeetAlongTheAxisThatCameLast) {
    const Meeting alongX = meet(during(2, 5), during(1, 9), 0);
    EXPECT_EQ(alongX.time, 2);
    EXPECT_EQ(alongX.axes, axisX);
    const Meeting alongY = meet(during(2, 5), during(3, 9), 0);
    EXPECT_EQ(alongY.time, 3);
    EXPECT_EQ(alongY.axes, axisY);
    const Meeting corner = meet(during(2, 5), during(2, 9), 0);
    EXPECT_EQ(corner.time, 2);
    EXPECT_EQ(corner.axes, axisX | axisY);
}

TEST(Trajectory, BoxesDoNotMeet) {
    EXPECT_EQ(meet(during(2, 5), during(5, 9), 0).time, never) << "one corner passes the other";
    EXPECT_EQ(meet(during(2, 5), during(6, 9), 0).time, never);
    EXPECT_EQ(meet(during(2, 5), Intervals<1>{}, 0).time, never);
    EXPECT_EQ(meet(during(2, 5), always, 3).time, never) << "they have met already";
    EXPECT_EQ(meet(during(2, 5), always, 2).time, 2);
}

TEST(Trajectory, BoxesMeetInTheFirstOfSeveralIntervals) {
    const Intervals<2> twice{{{1, 2}, {5, 6}}};
    EXPECT_EQ(meet(twice, Intervals<2>{{{0, 9}, {}}}, 0).time, 1);
    EXPECT_EQ(meet(twice, Intervals<2>{{{0, 9}, {}}}, 1.5).time, 5);
    EXPECT_EQ(meet(twice, Intervals<2>{{{3, 4}, {5.5, 9}}}, 0).time, 5.5);
}

TEST(Trajectory, WhatTouchesEndsWhenTheIntervalDoes) {
    EXPECT_TRUE(touches(during(2, 5), 5 - 1e-9, 9));
    EXPECT_FALSE(touches(during(2, 5), 5, 9));
    EXPECT_TRUE(touches(during(2, 5), 0, 2));
    EXPECT_FALSE(touches(during(5, 2), 0, 9));
    EXPECT_EQ(insideUntil(during(2, 5), 2), 5);
    EXPECT_EQ(insideUntil(during(2, 5), 5), -never);
}

}  // namespace
}  // namespace quadrille
