// Simulation::contacts: the contacts of the last step in canonical order, with what was exchanged.

#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <quadrille/names.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/state_hash.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

constexpr double dt = 1.0 / 64;

auto all(const Contact& c) {
    return std::tuple(c.a, c.b, c.time, c.axis, c.normal.x(), c.normal.y(), c.collided,
                      c.impulse.x(), c.impulse.y(), c.approach.x(), c.approach.y(), c.numberA,
                      c.numberB);
}

std::vector<Contact> copyOf(std::span<const Contact> contacts) {
    return {contacts.begin(), contacts.end()};
}

void expectEqual(const std::vector<Contact>& seen, const std::vector<Contact>& expected) {
    ASSERT_EQ(seen.size(), expected.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
        ASSERT_EQ(all(seen[i]), all(expected[i])) << "contact " << i;
    }
}

/// Enough bodies for contacts to be shared out.
World largeCrowd() {
    World world({.size = {700, 700}, .seed = 4});
    Random& random = world.random();
    for (int i = 0; i < 6000; ++i) {
        makeBody(world, {random.uniform(-350, 350), random.uniform(-350, 350)},
                 {.velocity = {random.uniform(-200, 200), random.uniform(-200, 200)}}, {4, 4});
    }
    return world;
}

class ContactsOf : public testing::TestWithParam<std::tuple<Law, Precision>> {
  protected:
    Law law() const { return std::get<0>(GetParam()); }
    SimulationConfig config() const {
        return {.partitioner = Quadtree{},
                .law = law(),
                .precision = std::get<1>(GetParam()),
                .step = {.dt = dt},
                .keepContacts = true};
    }
};

INSTANTIATE_TEST_SUITE_P(Laws, ContactsOf,
                         testing::Combine(testing::Values(Law::Baseline, Law::Impulse,
                                                          Law::Continuous),
                                          testing::Values(Precision::Double, Precision::Float)),
                         lawInPrecision);

TEST_P(ContactsOf, AHeadOnCollisionExchangesMassTimesChangeOfVelocity) {
    // Reduced mass 3/4, both velocities before and after known: the impulse is 2 * 3/4 * 64 = 96.
    World world;
    const Entity a = makeBody(world, {0, 0}, {.velocity = {64, 0}, .mass = 1}, {2, 2});
    const Entity b = makeBody(world, {2.5, 0}, {.mass = 3}, {2, 2});
    Simulation sim(std::move(world), config());
    sim.step();
    ASSERT_EQ(sim.contacts().size(), 1u);
    const Contact& c = sim.contacts()[0];
    EXPECT_EQ(c.a, a);
    EXPECT_EQ(c.b, b);
    EXPECT_TRUE(c.collided);
    EXPECT_EQ(c.axis, Axis::X);
    EXPECT_EQ(c.normal, Vec2(1, 0));
    EXPECT_EQ(c.impulse, Vec2(96, 0));
    EXPECT_EQ(c.approach, Vec2(64, 0));
    EXPECT_EQ(c.numberA, 0);
    EXPECT_EQ(c.numberB, 1);
    EXPECT_EQ(sim.world().get<PhysicsBody>(a).velocity, Vec2(64 - 96, 0));
    EXPECT_EQ(sim.world().get<PhysicsBody>(b).velocity, Vec2(96 / 3, 0));
}

TEST_P(ContactsOf, TheSecondBodyMayBeTheOneThatMoves) {
    World world;
    makeBody(world, {0, 2.5}, {.mass = 2}, {2, 2});
    makeBody(world, {0, 0}, {.velocity = {0, 64}, .mass = 2}, {2, 2});
    Simulation sim(std::move(world), config());
    sim.step();
    ASSERT_EQ(sim.contacts().size(), 1u);
    EXPECT_EQ(sim.contacts()[0].normal, Vec2(0, -1));
    EXPECT_EQ(sim.contacts()[0].impulse, Vec2(0, 128));
    EXPECT_EQ(sim.contacts()[0].approach, Vec2(0, 64));
}

TEST_P(ContactsOf, AWallTakesTwiceTheMomentum) {
    World world;
    makeBody(world, {0, 0}, {.velocity = {0, -64}, .mass = 5}, {2, 2});
    makeBody(world, {50, 0}, {.isStatic = true}, {2, 2});
    const Entity floor = makeBody(world, {0, -2.5}, {.isStatic = true}, {90, 2});
    Simulation sim(std::move(world), config());
    sim.step();
    ASSERT_EQ(sim.contacts().size(), 1u);
    const Contact& c = sim.contacts()[0];
    EXPECT_EQ(c.b, floor);
    EXPECT_EQ(c.impulse, Vec2(0, 2 * 5 * 64));
    EXPECT_EQ(c.approach, Vec2(0, 64));
    EXPECT_EQ(c.normal, Vec2(0, -1));
    EXPECT_EQ(c.numberB, -1 - 1);
}

TEST_P(ContactsOf, RestitutionScalesTheImpulse) {
    World world;
    makeBody(world, {0, 0}, {.velocity = {64, 0}, .mass = 2}, {2, 2});
    makeBody(world, {2.5, 0}, {.mass = 2}, {2, 2});
    SimulationConfig c = config();
    c.step.restitution = 0.5;
    Simulation sim(std::move(world), c);
    sim.step();
    ASSERT_EQ(sim.contacts().size(), 1u);
    EXPECT_EQ(sim.contacts()[0].impulse, Vec2(96, 0));
    EXPECT_EQ(sim.contacts()[0].approach, Vec2(64, 0));
}

TEST_P(ContactsOf, AStepAreThoseThatAListenerHears) {
    Simulation sim(crowd(), config());
    std::vector<Contact> heard;
    sim.onContact([&](const Contact& c) { heard.push_back(c); });
    std::size_t seen = 0;
    for (int i = 0; i < 20; ++i) {
        heard.clear();
        sim.step();
        expectEqual(copyOf(sim.contacts()), heard);
        seen += heard.size();
    }
    EXPECT_GT(seen, 500u);
}

TEST_P(ContactsOf, ImpulsesAreWhatTheVelocitiesChangedBy) {
    // In a step in which a body has one contact, its momentum changes by the impulse.
    if (law() == Law::Baseline) GTEST_SKIP() << "of several contacts only the last one counts";
    Simulation sim(crowd(2), config());
    const double tolerance = std::get<1>(GetParam()) == Precision::Double ? 1e-12 : 1e-3;
    int checked = 0;
    for (int i = 0; i < 20; ++i) {
        const World before = sim.world().clone();
        sim.step();
        std::vector<int> contactsOf(400);
        for (const Contact& c : sim.contacts()) {
            ++contactsOf.at(c.a.index);
            ++contactsOf.at(c.b.index);
        }
        for (const Contact& c : sim.contacts()) {
            if (contactsOf[c.a.index] != 1 || !c.collided) continue;
            ++checked;
            const Vec2 change =
                sim.world().get<PhysicsBody>(c.a).velocity - before.get<PhysicsBody>(c.a).velocity;
            const double mass = before.get<PhysicsBody>(c.a).mass;
            for (int k = 0; k < 2; ++k) {
                ASSERT_NEAR(mass * change[k], -c.normal[k] * c.impulse[k], tolerance);
                ASSERT_TRUE(c.normal[k] != 0 || c.impulse[k] == 0);
            }
        }
    }
    EXPECT_GT(checked, 100);
}

TEST(KeptContacts, AreTheSameOnThreads) {
    for (const Law law : {Law::Impulse, Law::Continuous}) {
        for (const Precision precision : {Precision::Double, Precision::Float}) {
            SCOPED_TRACE(std::string(name(law)) + ", " + std::string(name(precision)));
            const auto make = [&](ResolverKind resolver) {
                return Simulation(largeCrowd(), {.partitioner = Quadtree{},
                                                 .law = law,
                                                 .precision = precision,
                                                 .resolver = resolver,
                                                 .threads = 5,
                                                 .keepContacts = true});
            };
            Simulation sequential = make(ResolverKind::Sequential);
            Simulation threads = make(ResolverKind::Threads);
            for (int i = 0; i < 2; ++i) {
                sequential.step();
                threads.step();
                ASSERT_GT(sequential.contacts().size(), 1000u);
                expectEqual(copyOf(threads.contacts()), copyOf(sequential.contacts()));
            }
        }
    }
}

TEST(KeptContacts, AreThoseOfTheLastStepOnly) {
    World world;
    makeBody(world, {0, 0}, {.velocity = {64, 0}}, {2, 2});
    makeBody(world, {3.5, 0}, {.isStatic = true}, {2, 2});
    Simulation sim(std::move(world), {.step = {.dt = dt}, .keepContacts = true});
    EXPECT_TRUE(sim.contacts().empty()) << "before the first step";
    sim.step();
    EXPECT_TRUE(sim.contacts().empty());
    sim.step();
    EXPECT_EQ(sim.contacts().size(), 1u);
    sim.step();
    EXPECT_TRUE(sim.contacts().empty());
}

TEST(KeptContacts, KeepHandlesOfBodiesThatAListenerDestroys) {
    World world;
    const Entity ball = makeBody(world, {0, 0}, {.velocity = {64, 0}}, {2, 2});
    const Entity wall = makeBody(world, {2.5, 0}, {.isStatic = true}, {2, 2});
    Simulation sim(std::move(world), {.step = {.dt = dt}, .keepContacts = true});
    sim.onContact([&](const Contact& c) { sim.world().destroy(c.b); });
    sim.step();
    ASSERT_EQ(std::as_const(sim).contacts().size(), 1u);
    EXPECT_EQ(sim.contacts()[0].a, ball);
    EXPECT_EQ(sim.contacts()[0].b, wall);
    EXPECT_FALSE(sim.world().alive(wall));
}

TEST(KeptContacts, MustBeAskedFor) {
    Simulation sim(crowd(), {});
    sim.step();
    const std::string error = errorOf([&] { sim.contacts(); });
    EXPECT_NE(error.find("keepContacts"), std::string::npos) << error;
    SimulationConfig config = sim.config();
    config.keepContacts = true;
    sim.reconfigure(config);
    sim.step();
    EXPECT_GT(sim.contacts().size(), 0u);
    Simulation heard(crowd(), {});
    heard.onContact([](const Contact&) {});
    heard.step();
    EXPECT_GT(heard.contacts().size(), 0u);
}

TEST(KeptContacts, AreThereIfTheLastStepKeptThem) {
    Simulation sim(crowd(), {});
    Subscription subscription = sim.onContact([](const Contact&) {});
    sim.step();
    subscription.remove();
    EXPECT_GT(sim.contacts().size(), 0u) << "of the step that kept them";
    sim.step();
    sim.onContact([](const Contact&) {});
    EXPECT_THROW(sim.contacts(), Error) << "the listener came too late for this step";
    sim.step();
    EXPECT_GT(sim.contacts().size(), 0u);
}

TEST(KeptContacts, DoNotChangeTheRun) {
    for (const Law law : {Law::Baseline, Law::Impulse, Law::Continuous}) {
        Simulation kept(crowd(), {.law = law, .keepContacts = true});
        Simulation plain(crowd(), {.law = law});
        for (int i = 0; i < 10; ++i) {
            const StepReport report = kept.step();
            ASSERT_EQ(report.contacts, plain.step().contacts);
        }
        EXPECT_EQ(stateHash(kept.world()), stateHash(plain.world()));
    }
}

}  // namespace
}  // namespace quadrille
