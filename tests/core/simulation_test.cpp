#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/simulation.hpp>
#include <quadrille/state_hash.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

constexpr double dt = 1.0 / 64;  // exact, and so are the positions of the small cases below
constexpr double speed = 64;

SimulationConfig config() { return {.step = {.dt = dt}}; }

PhysicsBody moving(double vx, double vy = 0) { return {.velocity = {vx, vy}}; }
PhysicsBody fixed() { return {.isStatic = true}; }

/// Boxes of 2 x 2.
Entity makeBox(World& world, const Vec2& position, const PhysicsBody& body) {
    return makeBody(world, position, body, {2, 2});
}

std::vector<Contact> contactsOf(Simulation& sim, std::uint64_t steps = 1) {
    std::vector<Contact> contacts;
    sim.onContact([&](const Contact& c) { contacts.push_back(c); });
    sim.run(steps);
    return contacts;
}

// ---- time

TEST(Simulation, CountsStepsAndTime) {
    Simulation sim(World{}, config());
    EXPECT_EQ(sim.stepsDone(), 0u);
    EXPECT_EQ(sim.time(), 0);
    EXPECT_EQ(sim.step().step, 1u);
    sim.run(3);
    EXPECT_EQ(sim.stepsDone(), 4u);
    EXPECT_EQ(sim.time(), 4 * dt);
    sim.resumeAt(100);
    EXPECT_EQ(sim.step().step, 101u);
    EXPECT_EQ(sim.time(), 101 * dt);
}

// Parts of such steps are no time at all.
TEST(Simulation, StepsOfTheShortestTimeEnd) {
    for (const ResolverKind resolver : {ResolverKind::Sequential, ResolverKind::Threads}) {
        Simulation shortest(crowd(), {.resolver = resolver,
                                      .threads = 2,
                                      .step = {.dt = std::numeric_limits<double>::denorm_min()}});
        shortest.run(2);
        EXPECT_EQ(shortest.stepsDone(), 2u);

        World world;
        makeBox(world, {0, 0}, moving(1.25));
        Simulation late(std::move(world), {.resolver = resolver, .threads = 2, .step = {.dt = 1}});
        late.resumeAt(std::uint64_t(1) << 52);
        late.run(2);
        EXPECT_EQ(late.time(), 0x1p52 + 2);
    }
}

TEST(Simulation, MovesBodiesByVelocityAndGravity) {
    for (const Law law : {Law::Impulse, Law::Continuous}) {
        World world;
        const Entity e = makeBox(world, {0, 0}, moving(64, 32));
        SimulationConfig c = config();
        c.law = law;
        c.step.gravity = {0, -64};
        Simulation sim(std::move(world), c);
        sim.step();
        EXPECT_EQ(sim.world().get<PhysicsBody>(e).velocity, Vec2(64, 31));
        // The discrete law moves by the velocity at the end, the exact one by its mean.
        const double mean = law == Law::Impulse ? 31 : 31.5;
        EXPECT_EQ(sim.world().get<Transform>(e).position, Vec2(1, mean / 64));
    }
}

TEST(Simulation, ResultDependsNeitherOnHowStepsAreAskedForNorOnWhoWatches) {
    Simulation together(crowd(), config());
    together.run(20);
    Simulation single(crowd(), config());
    for (int i = 0; i < 20; ++i) single.step();
    Simulation watched(crowd(), config());
    watched.onContact([](const Contact&) {});
    watched.onStep([](const World&, const StepReport&) {});
    Simulation moved(std::move(watched));
    moved.run(20);
    EXPECT_EQ(stateHash(together.world()), stateHash(single.world()));
    EXPECT_EQ(stateHash(together.world()), stateHash(moved.world()));
}

// ---- contacts

TEST(Contacts, WithAStaticBody) {
    World world;
    makeBox(world, {0, 50}, fixed());
    makeBox(world, {0, -50}, moving(0));
    const Entity ball = makeBox(world, {0, 0}, moving(speed));
    const Entity wall = makeBox(world, {2.5, 0}, fixed());
    Simulation sim(std::move(world), config());
    const auto contacts = contactsOf(sim);
    ASSERT_EQ(contacts.size(), 1u);
    const Contact& c = contacts[0];
    EXPECT_EQ(c.a, ball);
    EXPECT_EQ(c.b, wall);
    EXPECT_EQ(c.time, dt / 2);
    EXPECT_EQ(c.axis, Axis::X);
    EXPECT_EQ(c.normal, Vec2(1, 0));
    EXPECT_TRUE(c.collided);
    EXPECT_EQ(c.numberA, 1);
    EXPECT_EQ(c.numberB, -1 - 1);
    EXPECT_EQ(sim.world().get<Transform>(ball).position, Vec2(0, 0));
    EXPECT_EQ(sim.world().get<PhysicsBody>(ball).velocity, Vec2(-speed, 0));
}

TEST(Contacts, OfMovingBodiesPutTheOneCreatedFirstFirst) {
    World world;
    makeBox(world, {50, 0}, moving(0));
    const Entity upper = makeBox(world, {0, 3}, moving(0, -speed));
    const Entity lower = makeBox(world, {0, 0}, moving(0, speed));
    Simulation sim(std::move(world), config());
    const auto contacts = contactsOf(sim);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].a, upper);
    EXPECT_EQ(contacts[0].b, lower);
    EXPECT_EQ(contacts[0].numberA, 1);
    EXPECT_EQ(contacts[0].numberB, 2);
    EXPECT_EQ(contacts[0].axis, Axis::Y);
    EXPECT_EQ(contacts[0].normal, Vec2(0, -1));
    EXPECT_EQ(contacts[0].time, dt / 2);
}

TEST(Contacts, AtACornerActAlongBothAxes) {
    World world;
    makeBox(world, {0, 0}, moving(speed, -speed));
    makeBox(world, {2.5, -2.5}, fixed());
    Simulation sim(std::move(world), config());
    const auto contacts = contactsOf(sim);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].axis, Axis::Both);
    EXPECT_EQ(contacts[0].normal, Vec2(1, -1));
}

TEST(Contacts, OfBodiesThatLeaveEachOtherAreNotCollisions) {
    World world;
    makeBox(world, {0, 0}, moving(-1));
    makeBox(world, {1.5, 0}, moving(1));
    SimulationConfig c = config();
    c.law = Law::Impulse;  // the exact one has no event there
    Simulation sim(std::move(world), c);
    const auto contacts = contactsOf(sim);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_FALSE(contacts[0].collided);
}

TEST(Contacts, TimeCountsFromTheStartOfTheRun) {
    World world;
    makeBox(world, {0, 0}, moving(speed));
    makeBox(world, {5.5, 0}, fixed());
    Simulation sim(std::move(world), config());
    const auto contacts = contactsOf(sim, 4);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].time, 3.5 * dt);
}

TEST(Contacts, AreThoseOfTheReportInOrderOfTime) {
    Simulation sim(crowd(), config());
    std::vector<Contact> contacts;
    sim.onContact([&](const Contact& c) { contacts.push_back(c); });
    for (int i = 0; i < 20; ++i) {
        contacts.clear();
        const StepReport& report = sim.step();
        EXPECT_EQ(report.contacts, contacts.size());
        std::uint64_t collisions = 0;
        for (std::size_t k = 0; k < contacts.size(); ++k) {
            collisions += contacts[k].collided;
            EXPECT_GE(contacts[k].time, (i == 0 ? 0 : sim.time() - dt));
            EXPECT_LE(contacts[k].time, sim.time());
            if (k > 0) {
                EXPECT_GE(contacts[k].time, contacts[k - 1].time);
            }
        }
        EXPECT_EQ(report.collisions, collisions);
        EXPECT_GT(report.contacts, 0u);
    }
}

// ---- systems, listeners, observers

TEST(Callbacks, RunInOrderAroundEachStep) {
    World world;
    const Entity e = makeBox(world, {0, 0}, moving(speed));
    Simulation sim(std::move(world), config());
    std::string order;
    sim.addSystem([&](World& w, double step) {
        EXPECT_EQ(step, dt);
        EXPECT_EQ(w.get<Transform>(e).position.x(), double(sim.stepsDone()));
        order += "a";
    });
    sim.addSystem([&](World&, double) { order += "b"; });
    sim.onStep([&](const World& w, const StepReport& report) {
        EXPECT_EQ(w.get<Transform>(e).position.x(), double(report.step));
        order += "o";
    });
    sim.run(2);
    EXPECT_EQ(order, "aboabo");
}

TEST(Callbacks, SystemMayCreateSteerAndDestroyBodies) {
    World world;
    const Entity ball = makeBox(world, {0, 0}, moving(speed));
    const Entity wall = makeBox(world, {2.5, 0}, fixed());
    Simulation sim(std::move(world), config());
    Entity made;
    sim.addSystem([&](World& w, double) {
        if (w.alive(wall)) w.destroy(wall);
        if (!w.alive(made)) made = makeBox(w, {50, 50}, moving(0, speed));
        w.set(ball, PhysicsBody{.velocity = {2 * speed, 0}});
    });
    sim.onContact([](const Contact&) { FAIL() << "the wall is gone"; });
    sim.step();
    EXPECT_EQ(sim.world().staticCount(), 0u);
    EXPECT_EQ(sim.world().get<Transform>(ball).position, Vec2(2, 0));
    EXPECT_EQ(sim.world().get<Transform>(made).position, Vec2(50, 51));
}

TEST(Callbacks, ListenerMayDestroyAndCreateBodiesAndOthersStillSeeTheContact) {
    World world;
    const Entity ball = makeBox(world, {0, 0}, moving(speed));
    const Entity wall = makeBox(world, {2.5, 0}, fixed());
    const Entity other = makeBox(world, {50, 0}, moving(speed));
    makeBox(world, {52.5, 0}, fixed());
    Simulation sim(std::move(world), config());
    int made = 0;
    sim.onContact([&](const Contact& c) {
        if (sim.world().alive(c.b)) sim.world().destroy(c.b);
        for (int i = 0; i < 100; ++i) makeBox(sim.world(), {4.0 * ++made, 90}, moving(0));
    });
    std::vector<std::pair<Entity, Entity>> seen;
    sim.onContact([&](const Contact& c) {
        EXPECT_FALSE(sim.world().alive(c.b));
        seen.emplace_back(c.a, c.b);
    });
    sim.step();
    ASSERT_EQ(seen.size(), 2u);
    EXPECT_NE(seen[0].first, seen[1].first);
    EXPECT_EQ(sim.world().staticCount(), 0u);
    EXPECT_EQ(sim.world().movingCount(), 202u);
    EXPECT_FALSE(sim.world().alive(wall));
    sim.step();
    EXPECT_EQ(seen.size(), 2u);
    EXPECT_EQ(sim.world().get<Transform>(ball).position, Vec2(-1, 0));
    EXPECT_EQ(sim.world().get<Transform>(other).position, Vec2(49, 0));
}

TEST(Callbacks, DestroyingInAListenerEqualsDestroyingBetweenSteps) {
    Simulation inside(crowd(), config());
    Simulation between(crowd(), config());
    inside.onContact([&](const Contact& c) {
        if (c.numberB >= 0 && c.b.index % 3 == 0 && inside.world().alive(c.b)) {
            inside.world().destroy(c.b);
        }
    });
    std::vector<Entity> condemned;
    between.onContact([&](const Contact& c) {
        if (c.numberB >= 0 && c.b.index % 3 == 0) condemned.push_back(c.b);
    });
    for (int i = 0; i < 30; ++i) {
        inside.step();
        between.step();
        for (const Entity e : condemned) {
            if (between.world().alive(e)) between.world().destroy(e);
        }
        condemned.clear();
        between.world().flush();
        ASSERT_EQ(stateHash(inside.world()), stateHash(between.world())) << "step " << i;
    }
    EXPECT_LT(inside.world().movingCount(), 300u);
}

}  // namespace
}  // namespace quadrille
