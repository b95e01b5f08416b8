// The law `impulse` against what is known exactly: reference/accuracy.md, sections 2 and 5.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include <quadrille/measure.hpp>
#include <quadrille/names.hpp>

#include "collision/random_scene.hpp"
#include "collision/support.hpp"

namespace quadrille {
namespace {

constexpr double dt = 1.0 / 64;  // exact, and so are the positions of the small cases

SimulationConfig config(Precision precision = Precision::Double) {
    return {.law = Law::Impulse, .precision = precision, .step = {.dt = dt}};
}

std::vector<double> sortedSpeeds(const World& world, int axis) {
    std::vector<double> speeds;
    world.visitBodies([&](const auto& bodies) {
        for (const double v : axis == 0 ? bodies.moving.vx : bodies.moving.vy) {
            speeds.push_back(std::abs(v));
        }
    });
    std::sort(speeds.begin(), speeds.end());
    return speeds;
}

/// Sum of m v^2 along an axis.
double energyAlong(const World& world, int axis) {
    double sum = 0;
    world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        for (std::size_t i = 0; i < m.size(); ++i) {
            const double v = axis == 0 ? m.vx[i] : m.vy[i];
            sum += m.mass[i] * v * v;
        }
    });
    return sum;
}

class Impulse : public testing::TestWithParam<Precision> {};

INSTANTIATE_TEST_SUITE_P(Precisions, Impulse, testing::Values(Precision::Double, Precision::Float),
                         [](const auto& test) { return std::string(name(test.param)); });

// ---- invariants

void expectSpeedsKept(Simulation sim, std::uint64_t steps) {
    sim.world().setPrecision(sim.config().precision);
    const auto x = sortedSpeeds(sim.world(), 0);
    const auto y = sortedSpeeds(sim.world(), 1);
    std::uint64_t collisions = 0;
    for (std::uint64_t i = 0; i < steps; ++i) collisions += sim.step().collisions;
    EXPECT_GT(collisions, steps / 10);
    EXPECT_EQ(sortedSpeeds(sim.world(), 0), x);
    EXPECT_EQ(sortedSpeeds(sim.world(), 1), y);
}

TEST_P(Impulse, EqualMassesKeepTheBitsOfTheirSpeedsInASparseScene) {
    expectSpeedsKept(simulationOf(shippedScene("balanced", 500), SemiStaticQuadtree{}, GetParam()),
                     2000);
}

TEST_P(Impulse, EqualMassesKeepTheBitsOfTheirSpeedsInADenseScene) {
    for (const SceneKind kind : {SceneKind::Clustered, SceneKind::OnePoint, SceneKind::Uniform}) {
        SCOPED_TRACE(name(kind));
        World world({.size = {256, 128}});
        world.addWalls({.thickness = 50});
        Random random(51);
        const double spread = kind == SceneKind::Uniform    ? 100
                              : kind == SceneKind::OnePoint ? 0
                                                            : 9;
        for (int i = 0; i < 200; ++i) {
            const Vec2 place(random.uniform(-spread, spread), random.uniform(-spread, spread) / 2);
            const Vec2 size(random.uniform(1, 8), random.uniform(1, 8));
            makeBox(world, place, moving(random.uniform(-90, 90), random.uniform(-90, 90), 0.7),
                    size);
        }
        expectSpeedsKept(Simulation(std::move(world), config(GetParam())), 300);
    }
}

TEST_P(Impulse, UnequalMassesKeepTheEnergyOfEachAxis) {
    const double bound = GetParam() == Precision::Double ? 1e-12 : 1e-4;
    World world({.size = {256, 128}});
    world.addWalls({.thickness = 50});
    Random random(52);
    for (int i = 0; i < 150; ++i) {
        const Vec2 place(random.uniform(-120, 120), random.uniform(-60, 60));
        makeBox(world, place,
                moving(random.uniform(-90, 90), random.uniform(-90, 90), random.uniform(0.1, 10)),
                {4, 4});
    }
    Simulation sim(std::move(world), config(GetParam()));
    const double x = energyAlong(sim.world(), 0);
    const double y = energyAlong(sim.world(), 1);
    std::uint64_t collisions = 0;
    for (int i = 0; i < 500; ++i) collisions += sim.step().collisions;
    EXPECT_GT(collisions, 3000u);
    EXPECT_NEAR(energyAlong(sim.world(), 0) / x, 1, bound);
    EXPECT_NEAR(energyAlong(sim.world(), 1) / y, 1, bound);
}

TEST_P(Impulse, APairKeepsItsMomentumAndItsRelativeVelocityFlips) {
    const double eps = GetParam() == Precision::Double ? 2.3e-16 : 1.2e-7;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const double e = seed % 3 == 0 ? 0 : seed % 3 == 1 ? 0.5 : 1;
        const double massA = random.uniform(0.1, 10);
        const double massB = random.uniform(0.1, 10);
        World world({.size = {256, 128}});
        const Entity a = makeBox(world, {-1.1, 0.3}, moving(random.uniform(20, 90), 7, massA));
        const Entity b = makeBox(world, {1.1, -0.2}, moving(-random.uniform(20, 90), -5, massB));
        SimulationConfig c = config(GetParam());
        c.step.restitution = e;
        Simulation sim(std::move(world), c);
        const Vec2 before = momentum(sim.world());
        const double closing = (velocityOf(sim, b) - velocityOf(sim, a)).x();
        ASSERT_EQ(sim.step().collisions, 1u);
        const Vec2 after = momentum(sim.world());
        ASSERT_NEAR(after.x(), before.x(), 8 * eps * 90 * (massA + massB));
        ASSERT_EQ(after.y(), before.y());
        const double opening = (velocityOf(sim, b) - velocityOf(sim, a)).x();
        ASSERT_NEAR(opening, -e * closing, 16 * eps * 180);
        // With e = 0 rounding decides whether they go on together or still approach by an ulp.
        ASSERT_TRUE(sim.step().collisions == 0 || e == 0);
    }
}

// ---- a collision of two ends where the exact one does

struct Exact {
    long double time;  // since the start of the step; negative if there is no impact
    int axis;
    long double lead;  // by how much the other axis' gap closed earlier
};

/// Impact of two boxes from their start, in extended precision.
Exact exactImpact(const Vec2& d, const Vec2& u, const Vec2& reach) {
    long double closed[2];
    for (int k = 0; k < 2; ++k) {
        const long double gap = std::abs((long double)d[k]) - reach[k];
        const long double speed = d[k] > 0 ? -(long double)u[k] : (long double)u[k];
        closed[k] = gap <= 0 ? -1 : speed > 0 ? gap / speed : 1e9L;
    }
    const int axis = closed[0] > closed[1] ? 0 : 1;
    return {closed[axis], axis, closed[axis] - closed[1 - axis]};
}

TEST_P(Impulse, ACollisionOfTwoEndsWhereTheExactOneDoes) {
    const double tolerance = GetParam() == Precision::Double ? 1e-12 : 1e-4;
    int tried = 0;
    for (std::uint64_t seed = 0; seed < 8000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const auto draw = [&](double r) { return double(float(random.uniform(-r, r))); };
        const Vec2 sizeA(2 + draw(1), 2 + draw(1));
        const Vec2 sizeB(2 + draw(1), 2 + draw(1));
        const Vec2 reach = (sizeA + sizeB) / 2;
        const Vec2 pa(draw(4), draw(4));
        const Vec2 pb(draw(4), draw(4));
        const Vec2 va(draw(90), draw(90));
        const Vec2 vb(draw(90), draw(90));
        const double massA = seed % 2 == 0 ? 1 : 1 + draw(0.9);
        const double massB = seed % 2 == 0 ? 1 : 1 + draw(0.9);
        const double e = seed % 5 == 0 ? 0.5 : 1;

        const Exact exact = exactImpact(pb - pa, vb - va, reach);
        const Vec2 end = (pb - pa) + dt * (vb - va);
        const bool overlapAtEnd = (reach - end.cwiseAbs()).minCoeff() > 1e-4;
        // A law that looks at the ends of steps only sees no other collisions.
        if (exact.time < 0 || exact.time > 0.999 * dt || !overlapAtEnd) continue;
        if (exact.lead < 1e-5) continue;  // rounding may decide about a corner
        ++tried;

        const int k = exact.axis;
        const long double total = (long double)massA + massB;
        const long double change = (1 + e) * ((long double)vb[k] - va[k]);
        const long double left = dt - exact.time;
        const long double newA = va[k] + massB / total * change;
        const long double newB = vb[k] - massA / total * change;
        Vec2 endA = pa + dt * va;
        Vec2 endB = pb + dt * vb;
        endA[k] = static_cast<double>(pa[k] + va[k] * exact.time + newA * left);
        endB[k] = static_cast<double>(pb[k] + vb[k] * exact.time + newB * left);

        World world({.size = {256, 128}});
        const Entity a = makeBox(world, pa, moving(va.x(), va.y(), massA), sizeA);
        const Entity b = makeBox(world, pb, moving(vb.x(), vb.y(), massB), sizeB);
        SimulationConfig c = config(GetParam());
        c.step.restitution = e;
        Simulation sim(std::move(world), c);
        ASSERT_EQ(sim.step().collisions, 1u);
        ASSERT_LT((positionOf(sim, a) - endA).norm(), tolerance);
        ASSERT_LT((positionOf(sim, b) - endB).norm(), tolerance);
        ASSERT_NEAR(velocityOf(sim, a)[k], double(newA), 100 * tolerance);
        ASSERT_NEAR(velocityOf(sim, b)[k], double(newB), 100 * tolerance);
        ASSERT_EQ(velocityOf(sim, a)[1 - k], va[1 - k]);
        ASSERT_EQ(velocityOf(sim, b)[1 - k], vb[1 - k]);
    }
    EXPECT_GT(tried, 300);
}

// ---- hard cases of section 5

TEST(ImpulseCases, ALightBodyAgainstAHeavyOne) {
    World world;
    const Entity heavy = makeBox(world, {0, 0}, moving(3, 0, 1));
    const Entity light = makeBox(world, {2.03, 0}, moving(-2, 0, 1e-6));
    Simulation sim(std::move(world), config());
    ASSERT_EQ(sim.step().collisions, 1u);
    EXPECT_NEAR(velocityOf(sim, heavy).x(), 2.99999000001, 1e-11);
    EXPECT_NEAR(velocityOf(sim, light).x(), 7.99999000001, 1e-11);
}

TEST_P(Impulse, PassingWithTheEdgesLevelIsNoCollision) {
    World world;
    const Entity a = makeBox(world, {-10, 0}, moving(64, 0));
    const Entity b = makeBox(world, {10, 2}, moving(-64, 0));
    const Entity wall = makeBox(world, {0, -3}, fixed(), {100, 4});
    Simulation sim(std::move(world), config(GetParam()));
    for (int i = 0; i < 20; ++i) ASSERT_EQ(sim.step().contacts, 0u);
    EXPECT_EQ(positionOf(sim, a), Vec2(10, 0));
    EXPECT_EQ(positionOf(sim, b), Vec2(-10, 2));
    EXPECT_EQ(positionOf(sim, wall), Vec2(0, -3));
}

TEST_P(Impulse, CornerToCornerBothReverse) {
    World world;
    // The corners meet in the middle of the step at (0, 0).
    const Entity a = makeBox(world, {-1.5, -1.5}, moving(64, 64));
    const Entity b = makeBox(world, {1.5, 1.5}, moving(-64, -64));
    Simulation sim(std::move(world), config(GetParam()));
    Contact contact;
    sim.onContact([&](const Contact& c) { contact = c; });
    ASSERT_EQ(sim.step().collisions, 1u);
    EXPECT_EQ(contact.axis, Axis::Both);
    EXPECT_EQ(contact.normal, Vec2(1, 1));
    EXPECT_EQ(contact.time, dt / 2);
    EXPECT_EQ(velocityOf(sim, a), Vec2(-64, -64));
    EXPECT_EQ(velocityOf(sim, b), Vec2(64, 64));
    EXPECT_EQ(positionOf(sim, a), Vec2(-1.5, -1.5));
    EXPECT_EQ(positionOf(sim, b), Vec2(1.5, 1.5));
}

TEST_P(Impulse, TwoSquaresAtTheSamePlaceSeparateAlongX) {
    for (const double speed : {0.0, 8.0}) {
        World world;
        const Entity first = makeBox(world, {5, 5}, moving(speed, 1));
        const Entity second = makeBox(world, {5, 5}, moving(speed, 1));
        Simulation sim(std::move(world), config(GetParam()));
        const double energy = kineticEnergy(sim.world());
        for (int i = 0; i < 10; ++i) sim.step();
        EXPECT_EQ(kineticEnergy(sim.world()), energy);
        EXPECT_EQ(overlap(sim.world()).pairs, 0u);
        const Vec2 middle = Vec2(5, 5) + 10 * dt * Vec2(speed, 1);
        EXPECT_EQ(positionOf(sim, first), middle - Vec2(1, 0));
        EXPECT_EQ(positionOf(sim, second), middle + Vec2(1, 0));
    }
}

TEST_P(Impulse, ManySquaresAtTheSamePlaceStayFiniteAndKeepTheirEnergy) {
    World world;
    for (int i = 0; i < 60; ++i) makeBox(world, {5, 5}, moving(i % 7 - 3, i % 5 - 2));
    Simulation sim(std::move(world), config(GetParam()));
    const double energy = kineticEnergy(sim.world());
    sim.run(500);
    EXPECT_EQ(kineticEnergy(sim.world()), energy);
    EXPECT_LT(overlap(sim.world()).max, 2);
    sim.world().visitBodies([](const auto& bodies) {
        for (std::size_t i = 0; i < bodies.moving.size(); ++i) {
            ASSERT_LT(std::abs(bodies.moving.x[i]), 1000);
            ASSERT_LT(std::abs(bodies.moving.y[i]), 1000);
        }
    });
}

TEST_P(Impulse, ADeepOverlapSeparatesAlongItsLeastAxis) {
    World world;
    // Depths 3 - 2.5 = 0.5 on y and 3 - 1 = 2 on x.
    const Entity a = makeBox(world, {0, 0}, moving(0, 4, 1), {3, 3});
    const Entity b = makeBox(world, {1, 2.5}, moving(0, -4, 3), {3, 3});
    Simulation sim(std::move(world), config(GetParam()));
    const Vec2 before = momentum(sim.world());
    const double energy = kineticEnergy(sim.world());
    double last = overlap(sim.world()).max;
    EXPECT_EQ(last, 0.5);
    for (int i = 0; i < 20; ++i) {
        sim.step();
        const double now = overlap(sim.world()).max;
        ASSERT_LE(now, last);
        last = now;
    }
    EXPECT_EQ(last, 0);
    EXPECT_EQ(momentum(sim.world()), before);
    EXPECT_EQ(kineticEnergy(sim.world()), energy);
    EXPECT_EQ(positionOf(sim, a).x(), 0);
    EXPECT_EQ(positionOf(sim, b).x(), 1);
    EXPECT_GE(positionOf(sim, b).y() - positionOf(sim, a).y(), 3);
}

TEST_P(Impulse, RandomDeepOverlapsFallMonotonically) {
    const double slack = GetParam() == Precision::Double ? 1e-12 : 1e-4;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const auto draw = [&](double r) { return random.uniform(-r, r); };
        World world;
        makeBox(world, {draw(2), draw(2)}, moving(draw(40), draw(40), 2 + draw(1.9)), {9, 7});
        makeBox(world, {draw(2), draw(2)}, moving(draw(40), draw(40), 2 + draw(1.9)), {5, 6});
        Simulation sim(std::move(world), config(GetParam()));
        const Vec2 before = momentum(sim.world());
        const double energy = kineticEnergy(sim.world());
        double last = overlap(sim.world()).max;
        ASSERT_GT(last, 0);
        for (int i = 0; i < 30; ++i) {
            sim.step();
            const double now = overlap(sim.world()).max;
            ASSERT_LE(now, last + slack) << "step " << i;
            last = now;
        }
        ASSERT_LE(last, slack);
        ASSERT_LT((momentum(sim.world()) - before).norm(), 500 * slack);
        ASSERT_NEAR(kineticEnergy(sim.world()) / energy, 1, 100 * slack);
    }
}

TEST_P(Impulse, RestitutionScalesTheVelocityAfterAWall) {
    for (const double e : {0.0, 0.5, 1.0}) {
        SCOPED_TRACE(e);
        World world;
        const Entity a = makeBox(world, {0, 0}, moving(64, 32));
        makeBox(world, {2.5, 0}, fixed(), {2, 50});
        SimulationConfig c = config(GetParam());
        c.step.restitution = e;
        Simulation sim(std::move(world), c);
        ASSERT_EQ(sim.step().collisions, 1u);
        EXPECT_EQ(velocityOf(sim, a), Vec2(-64 * e, 32));
        EXPECT_EQ(positionOf(sim, a), Vec2(0.5 - 0.5 * e, 0.5));
    }
}

}  // namespace
}  // namespace quadrille
