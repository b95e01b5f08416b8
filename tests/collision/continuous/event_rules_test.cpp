#include "collision/rules/event_rules.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/random.hpp>

#include "collision/rules/next_event.hpp"
#include "plain_world.hpp"
#include "reals.hpp"

namespace quadrille {
namespace {

template <class Real>
class EventRules : public testing::Test {};

TYPED_TEST_SUITE(EventRules, Reals, RealNames);

/// Enough digits for a few roundings of numbers of about 10.
template <class Real>
constexpr double tolerance = sizeof(Real) == sizeof(double) ? 1e-13 : 1e-5;

template <class Motion>
std::vector<PairEvent> eventsBetween(const Motion& motion, std::uint32_t a, BodyRef b, double from,
                                     double to) {
    std::vector<PairEvent> events;
    findBetween(motion, a, b, from, to, [&](const PairEvent& event) { events.push_back(event); });
    return events;
}

template <class Motion>
std::vector<PairEvent> eventsAfter(const Motion& motion, std::uint32_t row, BodyRef other,
                                   double now, double to) {
    std::vector<PairEvent> events;
    findFor(motion, row, std::array{other}, now, to,
            [&](const PairEvent& event) { events.push_back(event); });
    return events;
}

/// Carries one axis of an event out; no groups but the two bodies themselves.
template <class Real, class Path>
EventOutcome collideAlong(const ExactMotion<Real, Path>& motion, const PairEvent& event, int axis) {
    const EventContact contact = contactOf(motion, event);
    const double sense = axis == 0 ? contact.senseX : contact.senseY;
    return collide(motion, event, axis, sense, [&](int along, double side) {
        const auto sideOf = [&](BodyRef body, double direction) -> PushedSide {
            if (body.isStatic()) return {0, true};
            return {motion.bodies.moving.mass[body.row()], isHeld(motion, body, along, direction)};
        };
        const auto move = [&](std::uint32_t row) {
            return [&motion, row, along, now = event.time](double velocity) {
                goOnWith(motion, row, along, velocity, now);
            };
        };
        return collideGroups(motion, event, along, sideOf(BodyRef::moving(event.a), -side),
                             sideOf(event.b, side), move(event.a), move(event.b.row()));
    });
}

// ---- what happens next

TYPED_TEST(EventRules, TwoBodiesMeetWhenTheirEdgesDo) {
    PlainWorld<TypeParam, StraightPath> world;
    world.add({.x = 0, .vx = 3});
    world.add({.x = 10, .y = 1, .vx = -1});
    const auto motion = world.motion();
    const auto events = eventsBetween(motion, 0, BodyRef::moving(1), 0, 5);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].time, 2);
    EXPECT_EQ(events[0].a, 0u);
    EXPECT_EQ(events[0].b, BodyRef::moving(1));
    EXPECT_EQ(events[0].axes, axisX);
    EXPECT_FALSE(events[0].release);
    EXPECT_TRUE(eventsBetween(motion, 0, BodyRef::moving(1), 0, 1.9).empty()) << "not so soon";
}

TYPED_TEST(EventRules, TheFirstBodyOfAnEventWasCreatedFirst) {
    PlainWorld<TypeParam, StraightPath> world;
    world.add({.x = 0, .vx = 3});
    world.add({.x = 10, .vx = -1});
    EXPECT_EQ(eventsBetween(world.motion(), 1, BodyRef::moving(0), 0, 5).at(0).a, 0u);
    world.created = {1, 0};
    const auto events = eventsBetween(world.motion(), 0, BodyRef::moving(1), 0, 5);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].a, 1u);
    EXPECT_EQ(events[0].b, BodyRef::moving(0));
}

TYPED_TEST(EventRules, ABodyMeetsAStaticOneAtACorner) {
    PlainWorld<TypeParam, StraightPath> world;
    world.add({.x = 0, .y = 0, .vx = 2, .vy = -2});
    const BodyRef block = world.addStatic({.x = 6, .y = -6});
    const auto motion = world.motion();
    const auto events = eventsBetween(motion, 0, block, 0, 5);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].time, 2);
    EXPECT_EQ(events[0].axes, axisX | axisY);
    const EventContact contact = contactOf(motion, events[0]);
    EXPECT_EQ(contact.axes, axisX | axisY);
    EXPECT_EQ(contact.senseX, 1);
    EXPECT_EQ(contact.senseY, -1);
    EXPECT_FALSE(contact.deep);
}

TYPED_TEST(EventRules, NothingHappensToBodiesThatPassEachOther) {
    PlainWorld<TypeParam, StraightPath> world;
    world.add({.x = 0, .vx = 3});
    world.add({.x = 10, .y = 2, .vx = -1});  // level edges
    world.add({.x = 10, .y = 5, .vx = 9});
    EXPECT_TRUE(eventsBetween(world.motion(), 0, BodyRef::moving(1), 0, 5).empty());
    EXPECT_TRUE(eventsBetween(world.motion(), 0, BodyRef::moving(2), 0, 5).empty());
}

TYPED_TEST(EventRules, OverlapIsLookedAtAfterAnEventOnly) {
    PlainWorld<TypeParam, StraightPath> world;
    world.add({.x = 0, .vx = 3});
    world.add({.x = 1.5, .vx = -1});
    const auto motion = world.motion();
    EXPECT_TRUE(eventsBetween(motion, 0, BodyRef::moving(1), 0, 5).empty());
    const auto events = eventsAfter(motion, 0, BodyRef::moving(1), 0, 5);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].time, 0);
    EXPECT_EQ(events[0].axes, 0);
    const EventContact contact = contactOf(motion, events[0]);
    EXPECT_EQ(contact.axes, axisX);
    EXPECT_TRUE(contact.deep);
    // Once they part, nothing more happens.
    collideAlong(motion, events[0], 0);
    EXPECT_EQ(motion.bodies.moving.vx[0], TypeParam(-1));
    EXPECT_EQ(world.anchors[0].x, TypeParam(0)) << "deep inside, bodies stay where they are";
    EXPECT_TRUE(eventsAfter(motion, 0, BodyRef::moving(1), 0, 5).empty());
}

TYPED_TEST(EventRules, TheCheapTestMissesNoMeeting) {
    using Real = TypeParam;
    Random random(91);
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
        PlainWorld<Real, StraightPath> straight;
        PlainWorld<Real, FallingPath> falling(-50);
        for (int k = 0; k < 2; ++k) {
            const PlainBox box{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-9, 9),
                               random.uniform(-9, 9)};
            straight.add(box);
            falling.add(box);
        }
        const auto expectNear = [&](const auto& motion) {
            bool any = false;
            const BodyRef b = BodyRef::moving(1);
            findNext(motion, 0, motion.paths(0u), b, motion.paths(b), 0, 0.5, false,
                     [&](const PairEvent&) { any = true; });
            met += any;
            ASSERT_EQ(!eventsBetween(motion, 0, b, 0, 0.5).empty(), any) << i;
        };
        expectNear(straight.motion());
        expectNear(falling.motion());
    }
    EXPECT_GT(met, 2000);
}

// ---- elastic collisions

TYPED_TEST(EventRules, EqualMassesSwapTheirPathsBitForBit) {
    using Real = TypeParam;
    PlainWorld<Real, StraightPath> world;
    world.add({.x = 0.1, .vx = 3.3, .vy = 0.7});
    world.add({.x = 9.7, .vx = -1.1, .vy = 0.7});
    const Real first = world.vx[0];
    const Real second = world.vx[1];
    const auto motion = world.motion();
    const auto event = eventsBetween(motion, 0, BodyRef::moving(1), 0, 5).at(0);
    const EventOutcome outcome = collideAlong(motion, event, 0);
    EXPECT_EQ(outcome.outcome, Outcome::Collision);
    EXPECT_EQ(world.vx[0], second);
    EXPECT_EQ(world.vx[1], first);
    EXPECT_EQ(world.anchors[0].vx, second);
    EXPECT_EQ(world.anchors[1].vx, first);
    EXPECT_EQ(world.anchors[0].timeX, 0) << "paths are exchanged, not begun anew";
    EXPECT_EQ(world.vy[0], static_cast<Real>(0.7));
    const double closing = static_cast<double>(first) - static_cast<double>(second);
    EXPECT_EQ(outcome.approach, closing);
    EXPECT_EQ(outcome.impulse, closing);
    // They touch when they exchange.
    const double now = event.time;
    EXPECT_NEAR(motion.path(1u, 0).position(now) - motion.path(0u, 0).position(now), 2,
                10 * tolerance<Real>);
}

TYPED_TEST(EventRules, UnequalMassesExchangeWhatTheTextbookSays) {
    using Real = TypeParam;
    PlainWorld<Real, StraightPath> world;
    world.add({.x = 0, .vx = 2, .mass = 1});
    world.add({.x = 8, .vx = -1, .mass = 3});
    const auto motion = world.motion();
    const auto event = eventsBetween(motion, 0, BodyRef::moving(1), 0, 5).at(0);
    const EventOutcome outcome = collideAlong(motion, event, 0);
    EXPECT_NEAR(world.vx[0], -2.5, tolerance<Real>);
    EXPECT_NEAR(world.vx[1], 0.5, tolerance<Real>);
    EXPECT_NEAR(outcome.impulse, 4.5, tolerance<Real>);
    EXPECT_EQ(outcome.approach, 3);
    EXPECT_EQ(world.anchors[0].timeX, event.time);
    EXPECT_NEAR(world.anchors[0].x, 4, tolerance<Real>);
    EXPECT_NEAR(world.anchors[1].x, 6, tolerance<Real>);
}

TYPED_TEST(EventRules, CollisionsKeepMomentumAndWithRestitution1Energy) {
    using Real = TypeParam;
    Random random(92);
    for (int i = 0; i < 2000; ++i) {
        SCOPED_TRACE(i);
        const double restitution = i % 2 == 0 ? 1 : random.uniform(0.1, 0.9);
        PlainWorld<Real, StraightPath> world(0, restitution);
        world.add({.x = 0, .vx = random.uniform(1, 9), .mass = random.uniform(0.1, 5)});
        world.add({.x = 8, .vx = random.uniform(-9, 0), .mass = random.uniform(0.1, 5)});
        const auto sums = [&] {
            double momentum = 0;
            double energy = 0;
            for (std::size_t k = 0; k < 2; ++k) {
                const double m = world.mass[k];
                const double v = world.vx[k];
                momentum += m * v;
                energy += m * v * v / 2;
            }
            return std::pair(momentum, energy);
        };
        const auto before = sums();
        const double oldFirst = world.vx[0];
        const double closing = oldFirst - static_cast<double>(world.vx[1]);
        const auto motion = world.motion();
        const auto event = eventsBetween(motion, 0, BodyRef::moving(1), 0, 9).at(0);
        const EventOutcome outcome = collideAlong(motion, event, 0);
        ASSERT_EQ(outcome.outcome, Outcome::Collision);
        const auto after = sums();
        const double rounding = 200 * tolerance<Real>;
        ASSERT_NEAR(after.first, before.first, rounding);
        if (restitution == 1) {
            ASSERT_NEAR(after.second, before.second, rounding);
        }
        ASSERT_NEAR(static_cast<double>(world.vx[1]) - world.vx[0], restitution * closing,
                    rounding);
        ASSERT_NEAR(outcome.impulse, world.mass[0] * std::abs(world.vx[0] - oldFirst), rounding);
        ASSERT_EQ(outcome.approach, closing);
    }
}

TYPED_TEST(EventRules, AWallMirrorsAPathBitForBit) {
    using Real = TypeParam;
    PlainWorld<Real, StraightPath> world;
    world.add({.x = 0.25, .y = 0.5, .vx = 1, .vy = -3.3, .mass = 2});
    const BodyRef floor = world.addStatic({.x = 0, .y = -10, .width = 100});
    const Real speed = world.vy[0];
    const auto motion = world.motion();
    const auto event = eventsBetween(motion, 0, floor, 0, 5).at(0);
    EXPECT_EQ(event.axes, axisY);
    const EventOutcome outcome = collideAlong(motion, event, 1);
    EXPECT_EQ(outcome.outcome, Outcome::Collision);
    EXPECT_EQ(world.vy[0], -speed);
    EXPECT_EQ(world.vx[0], Real(1));
    EXPECT_EQ(world.anchors[0].y, Real(-16.5)) << "mirrored about -8";
    EXPECT_EQ(world.anchors[0].timeY, 0);
    EXPECT_EQ(outcome.approach, -static_cast<double>(speed));
    EXPECT_EQ(outcome.impulse, -4 * static_cast<double>(speed));
}

TYPED_TEST(EventRules, AFarAnchorIsMovedAlongItsPath) {
    PlainWorld<TypeParam, StraightPath> world;
    world.add({.x = 0});
    const auto motion = world.motion();
    const DoubleDouble anchor{-2990, std::ldexp(1.0, -55)};
    motion.setStraight(0, 0, anchor, 3, 0, 200, 2);
    EXPECT_EQ(motion.anchor(0, 0).high, -2990) << "600 px are near, 2390 px from the origin";
    EXPECT_EQ(world.anchors[0].timeX, 0);
    motion.setStraight(0, 0, anchor, 3, 0, 1000.3, 2);
    EXPECT_EQ(world.anchors[0].timeX, 992) << "a multiple of 2^4 s";
    EXPECT_EQ(motion.anchor(0, 0).high, -2990 + 3 * 992);
    EXPECT_EQ(motion.anchor(0, 0).low, std::ldexp(1.0, -55)) << "no digit is lost";
}

TYPED_TEST(EventRules, WhatPartsDoesNotCollide) {
    PlainWorld<TypeParam, StraightPath> world;
    world.add({.x = 0, .vx = -1});
    world.add({.x = 2, .vx = 1});
    PairEvent event = pairEvent(world.motion().bodies, 0, BodyRef::moving(1), 0);
    event.axes = axisX;
    EXPECT_EQ(collideAlong(world.motion(), event, 0).outcome, Outcome::Nothing);
    EXPECT_EQ(world.vx[0], TypeParam(-1));
}

// ---- restitution below 1

TEST(PushedSides, CollideAsOneBodyEach) {
    double va = 2;
    double vb = -2;
    collideSides(va, vb, {1, false}, {1, false}, 0.5);
    EXPECT_DOUBLE_EQ(va, -1);
    EXPECT_DOUBLE_EQ(vb, 1);
    va = 3;
    vb = 0;
    collideSides(va, vb, {4, false}, {2, false}, 0);
    EXPECT_DOUBLE_EQ(va, 2);
    EXPECT_DOUBLE_EQ(vb, 2);
}

TEST(PushedSides, ReboundFromWhatIsHeld) {
    double va = 2;
    double vb = -2;
    collideSides(va, vb, {1, false}, {9, true}, 0.5);
    EXPECT_DOUBLE_EQ(va, -2);
    EXPECT_DOUBLE_EQ(vb, 0);
    va = 2;
    vb = -2;
    collideSides(va, vb, {1, true}, {9, false}, 0.5);
    EXPECT_DOUBLE_EQ(va, 0);
    EXPECT_DOUBLE_EQ(vb, 2);
    collideSides(va, vb, {1, true}, {9, true}, 0.5);
    EXPECT_EQ(va, 0);
    EXPECT_EQ(vb, 0);
}

TEST(PushedSides, GoOnTogetherWhenTheyAreSlow) {
    double va = 1e-7;
    double vb = -1e-7;
    collideSides(va, vb, {3, false}, {1, false}, 0.5);
    EXPECT_EQ(va, vb);
    EXPECT_NEAR(va, 0.5e-7, 1e-20);
}

TYPED_TEST(EventRules, ABodyPushesAlongWhatTouchesItAndMovesWithIt) {
    PlainWorld<TypeParam, StraightPath> world(0, 0.5);
    world.add({.x = 0, .vx = 1});
    world.add({.x = 2, .vx = 1});            // touches
    world.add({.x = -2, .vx = 1});           // touches on the other side
    world.add({.x = 2.01, .vx = 1});         // a little apart
    world.add({.x = 2, .vx = 1.01});         // leaves
    world.add({.x = 2, .y = 2, .vx = 1});    // beside it
    world.add({.x = 2, .y = 1.9, .vx = 1});  // not quite
    const auto motion = world.motion();
    const auto pushes = [&](std::uint32_t b, double sense) {
        return pushesAlong(motion, 0, motion.path(0u, 0), BodyRef::moving(b), 0, sense, 0);
    };
    EXPECT_TRUE(pushes(1, 1));
    EXPECT_FALSE(pushes(1, -1));
    EXPECT_TRUE(pushes(2, -1));
    EXPECT_FALSE(pushes(2, 1));
    EXPECT_FALSE(pushes(3, 1));
    EXPECT_FALSE(pushes(4, 1));
    EXPECT_FALSE(pushes(5, 1));
    EXPECT_TRUE(pushes(6, 1));
}

TYPED_TEST(EventRules, AGroupGivesTheImpulseOfItsMass) {
    PlainWorld<TypeParam, StraightPath> world(0, 0.5);
    world.add({.x = 0, .vx = 2, .mass = 1});
    world.add({.x = 2, .vx = -1, .mass = 1});
    const auto motion = world.motion();
    PairEvent event = pairEvent(motion.bodies, 0, BodyRef::moving(1), 0);
    event.axes = axisX;
    const double given = collideGroups(
        motion, event, 0, {2, false}, {1, false},
        [&](double velocity) { goOnWith(motion, 0, 0, velocity, 0); },
        [&](double velocity) { goOnWith(motion, 1, 0, velocity, 0); });
    // 2 kg at 2 px/s and 1 kg at -1 px/s: 1.5 (-1 - 2) / 3 is the change of the heavy side.
    EXPECT_NEAR(world.vx[0], 0.5, tolerance<TypeParam>);
    EXPECT_NEAR(world.vx[1], 2, tolerance<TypeParam>);
    EXPECT_NEAR(given, 3, tolerance<TypeParam>);
}

TYPED_TEST(EventRules, BothHeldBothStop) {
    PlainWorld<TypeParam, StraightPath> world(0, 0.5);
    world.add({.x = 0, .vx = 2, .mass = 3});
    world.add({.x = 2, .vx = -1});
    const auto motion = world.motion();
    PairEvent event = pairEvent(motion.bodies, 0, BodyRef::moving(1), 0);
    event.axes = axisX;
    const auto unmoved = [](double) { FAIL() << "a group that is held"; };
    const double given = collideGroups(motion, event, 0, {9, true}, {9, true}, unmoved, unmoved);
    EXPECT_EQ(world.vx[0], TypeParam(0));
    EXPECT_EQ(world.vx[1], TypeParam(0));
    EXPECT_EQ(given, 6);
}

// Or it would meet the other one at the same instant again, without end.
TYPED_TEST(EventRules, WhatIsHeldStopsThoughItCrept) {
    for (const bool firstIsHeld : {true, false}) {
        PlainWorld<TypeParam, StraightPath> world(0, 0.5);
        world.add({.x = 0, .vx = firstIsHeld ? TypeParam(0.0625) : TypeParam(1)});
        world.add({.x = 2, .vx = firstIsHeld ? TypeParam(-1) : TypeParam(-0.0625)});
        const auto motion = world.motion();
        PairEvent event = pairEvent(motion.bodies, 0, BodyRef::moving(1), 0);
        event.axes = axisX;
        const auto move = [&](std::uint32_t row) {
            return [&, row](double velocity) { goOnWith(motion, row, 0, velocity, 0); };
        };
        collideGroups(motion, event, 0, {1, firstIsHeld}, {1, !firstIsHeld}, move(0), move(1));
        EXPECT_EQ(world.vx[firstIsHeld ? 0 : 1], TypeParam(0));
        // As the speed of approach was 1.0625.
        EXPECT_EQ(world.vx[firstIsHeld ? 1 : 0], TypeParam(firstIsHeld ? 0.53125 : -0.53125));
    }
}

// ---- gravity and rest

TYPED_TEST(EventRules, AFallingBodyReboundsFromTheFloor) {
    using Real = TypeParam;
    PlainWorld<Real, FallingPath> world(-10);
    world.add({.y = 6, .mass = 2});
    const BodyRef floor = world.addStatic({.y = -1, .width = 100});
    const auto motion = world.motion();
    const auto event = eventsBetween(motion, 0, floor, 0, 5).at(0);
    EXPECT_NEAR(event.time, 1, tolerance<Real>);  // 5 px at 10 px/s^2
    const EventOutcome outcome = collideAlong(motion, event, 1);
    EXPECT_EQ(outcome.outcome, Outcome::Collision);
    EXPECT_FALSE(outcome.rests);
    EXPECT_NEAR(outcome.approach, 10, tolerance<Real>);
    EXPECT_NEAR(outcome.impulse, 40, 10 * tolerance<Real>);
    EXPECT_NEAR(world.anchors[0].vy, 10, tolerance<Real>);
    EXPECT_EQ(world.anchors[0].y, Real(1));
    motion.place(0, 1.5);
    EXPECT_NEAR(world.y[0], 1 + 5 - 1.25, 10 * tolerance<Real>);
    EXPECT_NEAR(world.vy[0], 5, 10 * tolerance<Real>);
}

TYPED_TEST(EventRules, ABodyComesToRestAndSlidesOff) {
    using Real = TypeParam;
    PlainWorld<Real, FallingPath> world(-10, 0.5);
    world.add({.x = 0, .y = 1, .vx = 2});
    const BodyRef floor = world.addStatic({.x = 0, .y = -1, .width = 4});
    const auto motion = world.motion();
    const std::array others{floor};

    auto events = eventsAfter(motion, 0, floor, 0, 5);
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events[0].axes, axisY);
    EXPECT_EQ(events[0].time, 0);
    EXPECT_FALSE(events[0].release);
    const EventOutcome outcome = collideAlong(motion, events[0], 1);
    EXPECT_TRUE(outcome.rests);
    EXPECT_EQ(outcome.outcome, Outcome::Touch) << "it did not fall onto it";
    EXPECT_EQ(outcome.impulse, 0);
    EXPECT_TRUE(motion.rests(0, 1));
    EXPECT_FALSE(motion.rests(0, 0));
    EXPECT_TRUE(motion.holds(BodyRef::moving(0), 1));
    EXPECT_EQ(motion.path(0u, 1).acceleration, 0);
    EXPECT_TRUE(supported(motion, 0, others, 1, 0));
    EXPECT_FALSE(release(motion, 0, others, 1, 0));

    // 3 px to go at 2 px/s.
    events = eventsBetween(motion, 0, floor, 0, 5);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_TRUE(events[0].release);
    EXPECT_NEAR(events[0].time, 1.5, 10 * tolerance<Real>);
    EXPECT_TRUE(release(motion, 0, others, 1, events[0].time));
    EXPECT_FALSE(motion.rests(0, 1));
    EXPECT_EQ(motion.path(0u, 1).acceleration, -10);
    EXPECT_EQ(world.anchors[0].vy, Real(0));
    EXPECT_EQ(world.anchors[0].timeY, events[0].time);
}

TYPED_TEST(EventRules, WhatRestsIsHeldByItsSupportWithRestitutionBelow1) {
    using Real = TypeParam;
    PlainWorld<Real, FallingPath> world(-10, 0.5);
    world.add({.y = 1, .mass = 0.01});
    world.add({.y = 3, .vy = -4, .mass = 100});
    world.rests[0] = axisY;
    const auto motion = world.motion();
    PairEvent event = pairEvent(motion.bodies, 0, BodyRef::moving(1), 0);
    event.axes = axisY;
    const EventOutcome outcome = collideAlong(motion, event, 1);
    EXPECT_EQ(outcome.outcome, Outcome::Collision);
    EXPECT_EQ(world.anchors[1].vy, Real(2));
    EXPECT_EQ(world.anchors[0].vy, Real(0));
    EXPECT_TRUE(motion.rests(0, 1));
    EXPECT_EQ(outcome.impulse, 600);
    EXPECT_EQ(outcome.approach, 4);
}

TYPED_TEST(EventRules, ABodyStandsOnlyOnWhatIsBelow) {
    PlainWorld<TypeParam, FallingPath> world(-10);
    world.add({.y = 1});
    const BodyRef below = world.addStatic({.y = -1});
    const BodyRef above = world.addStatic({.y = 3});
    const BodyRef beside = world.addStatic({.x = 2, .y = -1});
    const BodyRef apart = world.addStatic({.y = -1.1});
    const auto motion = world.motion();
    EXPECT_EQ(restsUntil(motion, 0, below, 1, 0), never);
    EXPECT_EQ(restsUntil(motion, 0, above, 1, 0), -never);
    EXPECT_EQ(restsUntil(motion, 0, beside, 1, 0), -never) << "only their corners touch";
    EXPECT_EQ(restsUntil(motion, 0, apart, 1, 0), -never);
}

TEST(Rest, ComesWhereAReboundWouldNotLeaveTheRounding) {
    // A rebound of v rises by v^2 / 2 g.
    EXPECT_TRUE(comesToRest(0.1, 10, 0.001, 0.5));
    EXPECT_FALSE(comesToRest(0.3, 10, 0.001, 0.5));
    EXPECT_FALSE(comesToRest(0.2, 10, 0.001, 1));
    EXPECT_FALSE(comesToRest(0.1, 0, 0.001, 0.5)) << "nothing presses them together";
    EXPECT_FALSE(comesToRest(0.1, -10, 0.001, 0.5));
}

// ---- the partition

TYPED_TEST(EventRules, ABodyThatBecameTooFastOutrunsItsBound) {
    using Real = TypeParam;
    PlainWorld<Real, StraightPath> straight;
    straight.add({.vx = 2, .vy = -4});
    EXPECT_FALSE(outruns(straight.motion(), 0, 0, 1, SpeedBounds{.common = 4}));
    EXPECT_TRUE(outruns(straight.motion(), 0, 0, 1, SpeedBounds{.common = 3.9}));
    const double own = 4;
    EXPECT_FALSE(outruns(straight.motion(), 0, 0, 1, SpeedBounds{.common = 1, .own = &own}));
    PlainWorld<Real, FallingPath> falling(-10);
    falling.add({});
    EXPECT_FALSE(outruns(falling.motion(), 0, 0, 1, SpeedBounds{.common = 10}));
    EXPECT_TRUE(outruns(falling.motion(), 0, 0, 1, SpeedBounds{.common = 9.9}));
}

// ---- storage

/// A collision of bodies that lie in the rows of a permutation.
template <class Real, class Path>
std::vector<Anchor<Real>> collidedIn(std::array<std::uint32_t, 2> rowOf, double massB,
                                     double overlap) {
    PlainWorld<Real, Path> world(Path::falls ? -10 : 0, 1);
    const std::array<PlainBox, 2> boxes{{{.x = 0.25, .y = 1, .vx = 2.7, .vy = 0.3},
                                         {.x = 2.25 - overlap, .y = 1, .vx = -1.9, .mass = massB}}};
    const std::uint32_t first = rowOf[0] == 0 ? 0 : 1;
    world.add(boxes[first]);
    world.add(boxes[1 - first]);
    world.created = {first, 1 - first};
    const auto motion = world.motion();
    const std::uint32_t row = rowOf[0];
    PairEvent event = pairEvent(motion.bodies, row, BodyRef::moving(1 - row), 0);
    event.axes = overlap > 0 ? 0 : axisX;
    EXPECT_EQ(event.a, row);
    EXPECT_NE(collideAlong(motion, event, 0).outcome, Outcome::Nothing);
    return {world.anchors[rowOf[0]], world.anchors[rowOf[1]]};
}

template <class Real, class Path>
void expectRowsDoNotMatter(double massB, double overlap) {
    const auto p = collidedIn<Real, Path>({0, 1}, massB, overlap);
    const auto q = collidedIn<Real, Path>({1, 0}, massB, overlap);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(p[i].x, q[i].x);
        EXPECT_EQ(p[i].vx, q[i].vx);
        EXPECT_EQ(p[i].vy, q[i].vy);
        EXPECT_EQ(p[i].timeX, q[i].timeX);
    }
}

TYPED_TEST(EventRules, WhereBodiesAreStoredDoesNotMatter) {
    for (const double massB : {1.0, 0.7}) {
        for (const double overlap : {0.0, 0.5, 2.0}) {  // at 2, the centres agree
            SCOPED_TRACE(std::to_string(massB) + ", " + std::to_string(overlap));
            expectRowsDoNotMatter<TypeParam, StraightPath>(massB, overlap);
            expectRowsDoNotMatter<TypeParam, FallingPath>(massB, overlap);
        }
    }
}

}  // namespace
}  // namespace quadrille
