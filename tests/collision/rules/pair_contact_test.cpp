#include "collision/rules/pair_contact.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include <quadrille/random.hpp>

#include "reals.hpp"

namespace quadrille {
namespace {

template <class Real>
class ContactLaw : public testing::Test {};

TYPED_TEST_SUITE(ContactLaw, Reals, RealNames);

// ---- geometry

TYPED_TEST(ContactLaw, LevelEdgesDoNotOverlap) {
    using Real = TypeParam;
    const Real reach = 2;
    const Real less = std::nextafter(reach, Real(0));
    for (const Real sign : {Real(-1), Real(1)}) {
        EXPECT_FALSE(overlaps(sign * reach, Real(0), reach, reach));
        EXPECT_FALSE(overlaps(Real(0), sign * reach, reach, reach));
        EXPECT_TRUE(overlaps(sign * less, sign * less, reach, reach));
    }
    EXPECT_TRUE(overlaps(Real(0), Real(0), reach, reach));
    EXPECT_FALSE(overlaps(std::nan(""), 0.0, 2.0, 2.0));
}

TYPED_TEST(ContactLaw, LeastPenetrationTakesXWhereBothAreEqual) {
    using Real = TypeParam;
    const auto onX = leastPenetration(Real(-3), Real(1), Real(4), Real(6));
    EXPECT_EQ(onX.axis, axisX);
    EXPECT_EQ(onX.depth, Real(1));
    EXPECT_EQ(onX.sense, Real(-1));
    const auto onY = leastPenetration(Real(-3), Real(5.5), Real(4), Real(6));
    EXPECT_EQ(onY.axis, axisY);
    EXPECT_EQ(onY.depth, Real(0.5));
    EXPECT_EQ(onY.sense, Real(1));
    const auto tie = leastPenetration(Real(3), Real(-5), Real(4), Real(6));
    EXPECT_EQ(tie.axis, axisX);
    EXPECT_EQ(tie.sense, Real(1));
    const auto same = leastPenetration(Real(0), Real(0), Real(4), Real(4));
    EXPECT_EQ(same.axis, axisX);
    EXPECT_EQ(same.depth, Real(4));
    EXPECT_EQ(same.sense, Real(1));
}

// ---- impactOf

TYPED_TEST(ContactLaw, ImpactIsOnTheAxisWhoseGapClosedLast) {
    using Real = TypeParam;
    // Gaps at the start: x 3 - 2 = 1, closed after 1/4 of the step; y 2.5 - 2, after 1/2.
    const auto onY = impactOf(Real(-1), Real(1.5), Real(-4), Real(-1), Real(2), Real(2), Real(1));
    EXPECT_EQ(onY.axes, axisY);
    EXPECT_EQ(onY.since, Real(0.5));
    EXPECT_FALSE(onY.overlapBefore);
    EXPECT_EQ(onY.senseX, 1);  // where it came from, though it has passed the centre since
    EXPECT_EQ(onY.senseY, 1);

    // Overlap in y from the start, x gap closed after 3/4.
    const auto onX = impactOf(Real(-1.5), Real(0.5), Real(2), Real(0), Real(2), Real(2), Real(1));
    EXPECT_EQ(onX.axes, axisX);
    EXPECT_EQ(onX.since, Real(0.25));
    EXPECT_EQ(onX.senseX, -1);
    EXPECT_EQ(onX.senseY, 1);
}

TYPED_TEST(ContactLaw, ImpactAtACornerIsOnBothAxes) {
    using Real = TypeParam;
    const auto corner =
        impactOf(Real(1.5), Real(-1.5), Real(-1), Real(1), Real(2), Real(2), Real(1));
    EXPECT_EQ(corner.axes, axisX | axisY);
    EXPECT_EQ(corner.since, Real(0.5));
    EXPECT_EQ(corner.senseX, 1);
    EXPECT_EQ(corner.senseY, -1);
}

TYPED_TEST(ContactLaw, ImpactOfLevelEdgesAtTheStartIsAtTheStart) {
    using Real = TypeParam;
    const auto impact =
        impactOf(Real(1.5), Real(0), Real(-0.5), Real(0), Real(2), Real(2), Real(1));
    EXPECT_FALSE(impact.overlapBefore);
    EXPECT_EQ(impact.axes, axisX);
    EXPECT_EQ(impact.since, Real(1));
}

TYPED_TEST(ContactLaw, ImpactOfAnOldOverlapIsOnTheAxisOfLeastPenetration) {
    using Real = TypeParam;
    const auto onY =
        impactOf(Real(0.5), Real(-1.5), Real(0.25), Real(-0.25), Real(2), Real(2), Real(1));
    EXPECT_TRUE(onY.overlapBefore);
    EXPECT_EQ(onY.axes, axisY);
    EXPECT_EQ(onY.since, Real(0));
    EXPECT_EQ(onY.senseY, -1);
    const auto tie = impactOf(Real(-1), Real(1), Real(0), Real(0), Real(2), Real(2), Real(1));
    EXPECT_EQ(tie.axes, axisX);
    EXPECT_EQ(tie.senseX, -1);
    const auto same = impactOf(Real(0), Real(-0.0), Real(0), Real(0), Real(2), Real(2), Real(1));
    EXPECT_TRUE(same.overlapBefore);
    EXPECT_EQ(same.axes, axisX);
    EXPECT_EQ(same.senseX, 1);
    EXPECT_EQ(same.senseY, 1);
}

TYPED_TEST(ContactLaw, ImpactsOfRandomPairsLieWithinTheStepAndMirror) {
    using Real = TypeParam;
    Random random(11);
    const auto draw = [&](double low, double high) {
        return static_cast<Real>(random.uniform(low, high));
    };
    const Real dt = Real(1) / 60;
    int impacts = 0;
    for (int i = 0; i < 20000; ++i) {
        SCOPED_TRACE(i);
        const Real reachX = draw(0.1, 5);
        const Real reachY = draw(0.1, 5);
        const Real dx = draw(-1, 1) * reachX;
        const Real dy = draw(-1, 1) * reachY;
        const Real ux = draw(-300, 300);
        const Real uy = draw(-300, 300);
        const auto p = impactOf(dx, dy, ux, uy, reachX, reachY, dt);
        ASSERT_GE(p.since, Real(0));
        ASSERT_LE(p.since, dt);
        if (p.overlapBefore) {
            ASSERT_EQ(p.since, Real(0));
        } else {
            ++impacts;
            // At the impact the boxes touch on the contact's axis, from that side.
            const bool onX = p.axes == axisX;
            const Real at = onX ? dx - ux * p.since : dy - uy * p.since;
            const Real reach = onX ? reachX : reachY;
            ASSERT_NEAR(at * Real(onX ? p.senseX : p.senseY), reach, 1e-5 * reach);
        }
        // Seen from the other body; and with the axes swapped.
        const auto q = impactOf(-dx, -dy, -ux, -uy, reachX, reachY, dt);
        ASSERT_EQ(q.since, p.since);
        ASSERT_EQ(q.axes, p.axes);
        ASSERT_EQ(q.senseX, -p.senseX);
        ASSERT_EQ(q.senseY, -p.senseY);
        const auto s = impactOf(dy, dx, uy, ux, reachY, reachX, dt);
        ASSERT_EQ(s.since, p.since);
        ASSERT_EQ(s.senseX, p.senseY);
    }
    EXPECT_GT(impacts, 5000);
}

// ---- exchangeImpulse

TYPED_TEST(ContactLaw, EqualMassesSwapTheirBits) {
    using Real = TypeParam;
    Random random(12);
    for (int i = 0; i < 10000; ++i) {
        const auto a = static_cast<Real>(random.uniform(-100, 100));
        const auto b = static_cast<Real>(random.uniform(-100, 100));
        Real va = a;
        Real vb = b;
        exchangeImpulse(va, vb, Real(0.3), Real(0.3), Real(1));
        ASSERT_EQ(va, b);
        ASSERT_EQ(vb, a);
    }
}

TYPED_TEST(ContactLaw, UnequalMassesKeepMomentumAndRestitution) {
    using Real = TypeParam;
    constexpr double eps = std::numeric_limits<Real>::epsilon();
    Random random(13);
    for (int i = 0; i < 10000; ++i) {
        SCOPED_TRACE(i);
        const auto a = static_cast<Real>(random.uniform(-100, 100));
        const auto b = static_cast<Real>(random.uniform(-100, 100));
        const auto massA = static_cast<Real>(random.uniform(0.1, 10));
        const auto massB = static_cast<Real>(random.uniform(0.1, 10));
        const auto e = static_cast<Real>(i % 3 == 0 ? 1 : random.uniform(0, 1));
        Real va = a;
        Real vb = b;
        exchangeImpulse(va, vb, massA, massB, e);
        const double before = double(massA) * a + double(massB) * b;
        const double after = double(massA) * va + double(massB) * vb;
        ASSERT_NEAR(after, before, 8 * eps * 100 * double(massA + massB));
        ASSERT_NEAR(double(vb) - va, -double(e) * (double(b) - a), 16 * eps * 200);
    }
}

TYPED_TEST(ContactLaw, PerfectlyInelasticBodiesGoOnTogether) {
    using Real = TypeParam;
    Real va = 6;
    Real vb = 0;
    exchangeImpulse(va, vb, Real(1), Real(1), Real(0));
    EXPECT_EQ(va, Real(3));
    EXPECT_EQ(vb, Real(3));
}

// ---- collide and collideStatic

TYPED_TEST(ContactLaw, CollideEndsWhereTheExactCollisionDoes) {
    using Real = TypeParam;
    // a came with 4 and hit b, at rest, half a second ago; they swap.
    AxisState<Real> a{1, 4};
    AxisState<Real> b{1, 0};
    EXPECT_TRUE(
        collide(a, b, Real(1), Real(1), Real(1), Real(2), Real(1), Real(0.5), false).collided);
    EXPECT_EQ(a.position, Real(-1));
    EXPECT_EQ(a.velocity, Real(0));
    EXPECT_EQ(b.position, Real(3));
    EXPECT_EQ(b.velocity, Real(4));
}

TYPED_TEST(ContactLaw, CollideLeavesSeparatingBodiesAlone) {
    using Real = TypeParam;
    for (const Real v : {Real(0), Real(3)}) {
        AxisState<Real> a{0, -v};
        AxisState<Real> b{1, v};
        EXPECT_FALSE(
            collide(a, b, Real(1), Real(1), Real(1), Real(2), Real(1), Real(0.5), false).collided);
        EXPECT_EQ(a.position, Real(0));
        EXPECT_EQ(b.position, Real(1));
        EXPECT_EQ(b.velocity, v);
    }
}

TYPED_TEST(ContactLaw, CollidePushesOldOverlapsApartByInverseMass) {
    using Real = TypeParam;
    // Depth 4 - 2 = 2: b is three times as heavy and goes a quarter of it.
    AxisState<Real> a{0, -1};
    AxisState<Real> b{-2, 1};
    EXPECT_TRUE(
        collide(a, b, Real(1), Real(3), Real(1), Real(4), Real(-1), Real(0), true).collided);
    EXPECT_EQ(a.position, Real(1.5));
    EXPECT_EQ(b.position, Real(-2.5));
    EXPECT_EQ(a.velocity, Real(2));  // -1 + 3/4 * 2 * 2
    EXPECT_EQ(b.velocity, Real(0));
    // Somebody else has separated them meanwhile: nothing to push.
    AxisState<Real> c{0, -1};
    AxisState<Real> d{5, 1};
    EXPECT_FALSE(
        collide(c, d, Real(1), Real(3), Real(1), Real(4), Real(1), Real(0), true).collided);
    EXPECT_EQ(c.position, Real(0));
    EXPECT_EQ(d.position, Real(5));
}

TYPED_TEST(ContactLaw, CollideStaticReflects) {
    using Real = TypeParam;
    AxisState<Real> a{9, 4};  // the wall's surface is at 8 for its centre; hit 1/4 s ago
    EXPECT_TRUE(
        collideStatic(a, Real(3), Real(10), Real(1), Real(2), Real(1), Real(0.25), false, Real(0))
            .collided);
    EXPECT_EQ(a.position, Real(7));
    EXPECT_EQ(a.velocity, Real(-4));

    AxisState<Real> half{9, 4};
    EXPECT_TRUE(collideStatic(half, Real(3), Real(10), Real(0.5), Real(2), Real(1), Real(0.25),
                              false, Real(0))
                    .collided);
    EXPECT_EQ(half.velocity, Real(-2));
    EXPECT_EQ(half.position, Real(7.5));

    AxisState<Real> leaving{9, -4};
    EXPECT_FALSE(collideStatic(leaving, Real(3), Real(10), Real(1), Real(2), Real(1), Real(0.25),
                               false, Real(0))
                     .collided);
    EXPECT_EQ(leaving.position, Real(9));

    AxisState<Real> inside{9, -4};
    EXPECT_FALSE(
        collideStatic(inside, Real(3), Real(10), Real(1), Real(2), Real(1), Real(0), true, Real(0))
            .collided);
    EXPECT_EQ(inside.position, Real(8));
    EXPECT_EQ(inside.velocity, Real(-4));
}

TYPED_TEST(ContactLaw, CollideStaticReflectsTheVelocityOfTheImpact) {
    using Real = TypeParam;
    // Falling with 10 at the end of the step, of which 2 were gained in the half second since the
    // impact: 8 hit, and 8 - 2 = 6 are left at the end.
    AxisState<Real> a{-1, -10};
    EXPECT_TRUE(
        collideStatic(a, Real(3), Real(-2), Real(1), Real(2), Real(-1), Real(0.5), false, Real(-2))
            .collided);
    EXPECT_EQ(a.velocity, Real(6));
    EXPECT_EQ(a.position, Real(7));
    // Too slow to leave again: it rests on the surface.
    AxisState<Real> b{-1, -3};
    EXPECT_TRUE(
        collideStatic(b, Real(3), Real(-2), Real(0), Real(2), Real(-1), Real(0.5), false, Real(-2))
            .collided);
    EXPECT_EQ(b.velocity, Real(0));
    EXPECT_EQ(b.position, Real(0.5));
}

// ---- the law baseline

TYPED_TEST(ContactLaw, BaselineVelocityIsTheReportsFormula) {
    using Real = TypeParam;
    // v - (v - v_other) 2 m_other / (m_self + m_other)
    EXPECT_EQ(baselineVelocity(Real(3), Real(-5), Real(0.5), Real(1)), Real(-5));
    EXPECT_EQ(baselineVelocity(Real(3), Real(0), Real(1), Real(1)), Real(-3));
    EXPECT_EQ(baselineVelocity(Real(2), Real(-2), Real(0.25), Real(1)), Real(0));
    EXPECT_EQ(baselineVelocity(Real(4), Real(0), Real(1), Real(0.5)), Real(-2));
    EXPECT_EQ(baselineVelocity(Real(4), Real(0), Real(0.5), Real(0)), Real(2));
}

}  // namespace
}  // namespace quadrille
