// Simulation::snapshot and restore, in memory: a run goes on from there bit for bit, and what runs
// it stays as it is. A const World hands out nothing that can be written.

#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <quadrille/names.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/snapshot.hpp>
#include <quadrille/state_hash.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

struct Health {
    int points = 0;
};

class Restore : public testing::TestWithParam<std::tuple<Law, Precision>> {
  protected:
    Law law() const { return std::get<0>(GetParam()); }
    SimulationConfig config(bool falls = true) const {
        return {.partitioner = Quadtree{},
                .law = law(),
                .precision = std::get<1>(GetParam()),
                .step = {.gravity = {0, falls ? -40.0 : 0.0}, .restitution = falls ? 0.9 : 1}};
    }
};

INSTANTIATE_TEST_SUITE_P(Laws, Restore,
                         testing::Combine(testing::Values(Law::Baseline, Law::Impulse,
                                                          Law::Continuous),
                                          testing::Values(Precision::Double, Precision::Float)),
                         lawInPrecision);

std::vector<std::uint64_t> hashesOf(Simulation& sim, int steps) {
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < steps; ++i) {
        sim.step();
        hashes.push_back(stateHash(sim.world()));
    }
    return hashes;
}

TEST_P(Restore, GoesBackAndOnWithTheSameBits) {
    for (const bool falls : {false, true}) {
        SCOPED_TRACE(falls ? "with gravity" : "without gravity");
        Simulation sim(crowd(5, 150), config(falls));
        sim.run(12);
        const std::uint64_t then = stateHash(sim.world());
        const Snapshot snapshot = std::as_const(sim).snapshot();
        EXPECT_EQ(snapshot.stepsDone, 12u);
        EXPECT_EQ(snapshot.law, law());
        EXPECT_EQ(snapshot.step.gravity, sim.config().step.gravity);
        const auto expected = hashesOf(sim, 15);
        EXPECT_EQ(stateHash(snapshot.world), then) << "a copy, which does not go on";
        for (int again = 0; again < 2; ++again) {
            sim.restore(snapshot);
            EXPECT_EQ(stateHash(sim.world()), then);
            EXPECT_EQ(sim.stepsDone(), 12u);
            EXPECT_EQ(hashesOf(sim, 15), expected);
        }
    }
}

TEST_P(Restore, TakingASnapshotDoesNotChangeTheRun) {
    Simulation sim(crowd(6, 150), config());
    Simulation undisturbed(crowd(6, 150), config());
    for (int i = 0; i < 10; ++i) {
        static_cast<void>(sim.snapshot());
        ASSERT_EQ(hashesOf(sim, 2), hashesOf(undisturbed, 2));
    }
}

TEST_P(Restore, WorksInAnotherSimulation) {
    Simulation sim(crowd(7, 100), config());
    sim.run(8);
    const Snapshot snapshot = sim.snapshot();
    const auto expected = hashesOf(sim, 10);
    // Of another law, precision, time step, gravity and size, and with other bodies in it.
    Simulation other(World({.size = {10, 10}}),
                     {.partitioner = StaticGrid{{9, 9}}, .step = {.dt = 0.25, .restitution = 0.1}});
    other.run(3);
    other.restore(snapshot);
    EXPECT_EQ(other.config().law, law());
    EXPECT_EQ(other.config().precision, config().precision);
    EXPECT_EQ(other.config().step.dt, 1.0 / 60);
    EXPECT_EQ(name(other.config().partitioner), "static-grid");
    EXPECT_EQ(other.time(), 8 * other.config().step.dt);
    // The law `baseline` depends on the cells.
    if (law() == Law::Baseline) other.setPartitioner(Quadtree{});
    EXPECT_EQ(hashesOf(other, 10), expected);
}

TEST_P(Restore, BodiesMayBeAddedAfterwards) {
    Simulation sim(crowd(8, 100), config());
    sim.run(5);
    const Snapshot snapshot = sim.snapshot();
    const auto goOn = [&] {
        makeBody(sim.world(), {0, 0}, {.velocity = {20, 0}});
        sim.world().destroy(sim.world().at(20));
        return hashesOf(sim, 10);
    };
    const auto expected = goOn();
    sim.restore(snapshot);
    EXPECT_EQ(goOn(), expected);
}

TEST(RestoreInMemory, KeepsListenersAndWhatElseBelongsToTheSimulation) {
    Simulation sim(crowd(), {.keepContacts = true, .profile = true});
    const Snapshot snapshot = sim.snapshot();
    int heard = 0;
    int steps = 0;
    int systems = 0;
    Subscription contact = sim.onContact([&](const Contact&) { ++heard; });
    sim.onStep([&](const World& world, const StepReport&) {
        ++steps;
        EXPECT_EQ(&world, &sim.world());
    });
    sim.addSystem([&](World&, double) { ++systems; });
    sim.step();
    const int first = heard;
    EXPECT_GT(first, 0);
    EXPECT_FALSE(sim.contacts().empty());
    sim.restore(snapshot);
    EXPECT_TRUE(sim.contacts().empty()) << "of a step that is undone";
    EXPECT_TRUE(sim.config().profile);
    sim.step();
    EXPECT_EQ(heard, 2 * first);
    EXPECT_EQ(steps, 2);
    EXPECT_EQ(systems, 2);
    EXPECT_TRUE(contact.active());
}

TEST(RestoreInMemory, HasComponentsOfTheUsersOwnTypes) {
    World world;
    const Entity e = makeBody(world, {0, 0});
    world.add(e, Health{3});
    Simulation sim(std::move(world));
    const Snapshot snapshot = sim.snapshot();
    sim.world().get<Health>(e).points = 0;
    sim.restore(snapshot);
    EXPECT_EQ(sim.world().get<Health>(e).points, 3);
    // What the simulation does with it afterwards is not the snapshot's.
    sim.world().get<Health>(e).points = 1;
    sim.restore(snapshot);
    EXPECT_EQ(sim.world().get<Health>(e).points, 3);
}

TEST(RestoreInMemory, OfALawThatTheResolverDoesNotRunChangesNothing) {
    Simulation baseline(crowd(1, 50), {.law = Law::Baseline});
    baseline.run(4);
    const Snapshot snapshot = baseline.snapshot();
    const SimulationConfig config{
        .law = Law::Impulse, .resolver = ResolverKind::Threads, .threads = 2};
    Simulation sim(crowd(2), config);
    Simulation undisturbed(crowd(2), config);
    sim.run(3);
    undisturbed.run(3);
    EXPECT_THROW(sim.restore(snapshot), NotAvailable);
    EXPECT_EQ(sim.config().law, Law::Impulse);
    EXPECT_EQ(sim.stepsDone(), 3u);
    EXPECT_EQ(hashesOf(sim, 5), hashesOf(undisturbed, 5));
}

TEST(RestoreInMemory, OfSettingsThatCannotBeChangesNothing) {
    Simulation sim(crowd());
    Snapshot bad = sim.snapshot();
    sim.run(2);
    bad.step.dt = -1;
    const auto before = stateHash(sim.world());
    EXPECT_THROW(sim.restore(bad), Error);
    EXPECT_EQ(stateHash(sim.world()), before);
    EXPECT_EQ(sim.stepsDone(), 2u);
}

TEST(RestoreInMemory, GoesOnAsAFileDoes) {
    const TemporaryFolder folder;
    for (const Law law : {Law::Impulse, Law::Continuous}) {
        SCOPED_TRACE(name(law));
        Simulation sim(crowd(9, 100), {.law = law, .step = {.gravity = {5, -30}}});
        sim.run(6);
        saveSnapshot(folder.path() / "file", sim, "crowd", 9);
        const Snapshot file = loadSnapshot(folder.path() / "file");
        const Snapshot memory = sim.snapshot();
        const auto expected = hashesOf(sim, 10);
        for (const Snapshot* snapshot : {&file, &memory}) {
            sim.restore(*snapshot);
            EXPECT_EQ(hashesOf(sim, 10), expected);
        }
    }
}

// ---- what a const World hands out

template <class C>
using FromConst = decltype(std::declval<const World&>().get<C>(Entity{}));
template <class C>
using FromWorld = decltype(std::declval<World&>().get<C>(Entity{}));

// Body components are values, and const, so that nobody writes to a copy and believes the body
// moved.
static_assert(std::is_same_v<FromWorld<Transform>, const Transform>);
static_assert(std::is_same_v<FromWorld<BoxCollider>, const BoxCollider>);
static_assert(std::is_same_v<FromWorld<PhysicsBody>, const PhysicsBody>);
static_assert(std::is_same_v<FromConst<PhysicsBody>, const PhysicsBody>);
static_assert(!std::is_assignable_v<FromWorld<Transform>, Transform>);
static_assert(std::is_same_v<FromWorld<Health>, Health&>);
static_assert(std::is_same_v<FromConst<Health>, const Health&>);
static_assert(std::is_same_v<decltype(std::declval<const Simulation&>().world()), const World&>);
static_assert(
    std::is_same_v<decltype(std::declval<World&>().bodies<double>().moving.x[0]), const double&>);

TEST(ConstWorld, IsEnoughForAllWhoOnlyLook) {
    Simulation sim(crowd(1, 20));
    sim.step();
    const World& world = std::as_const(sim).world();
    EXPECT_EQ(world.movingCount(), 20u);
    EXPECT_EQ(world.bodies<double>().size(), 24u);
    EXPECT_EQ(world.validate().size(), 0u);
    EXPECT_EQ(stateHash(world), stateHash(world.clone()));
    int seen = 0;
    world.each<Transform, PhysicsBody>(
        [&](Entity, const Transform&, const PhysicsBody&) { ++seen; });
    EXPECT_EQ(seen, 24);
    double sum = 0;
    world.visitBodies([&](const auto& bodies) {
        for (const double x : bodies.moving.x) sum += x;
    });
    EXPECT_NE(sum, 0);
}

TEST(EditBodies, WritesManyAndCountsOneEdit) {
    World world = crowd(1, 20);
    const std::uint64_t before = world.bodies<double>().revision;
    world.editBodies([](const auto& bodies) {
        for (auto& v : bodies.moving.vx) v = 0;
        for (auto& x : bodies.moving.x) x += 1;
    });
    EXPECT_EQ(world.bodies<double>().revision, before + 1);
    for (const double v : world.bodies<double>().moving.vx) EXPECT_EQ(v, 0);
    EXPECT_EQ(world.editBodies([](const auto& bodies) { return bodies.moving.size(); }), 20u);
}

TEST(EditBodies, IsSeenByTheLawContinuous) {
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        World world;
        const Entity ball = makeBody(world, {0, 0}, {.velocity = {60, 0}}, {2, 2});
        makeBody(world, {11.5, 30}, {.isStatic = true}, {1, 2});
        Simulation sim(std::move(world), {.law = Law::Continuous, .precision = precision});
        sim.run(3);
        sim.world().editBodies([](const auto& bodies) { bodies.moving.y[0] = 30; });
        sim.run(10);
        // At x = 10 it meets the wall that was beside its way before: 10 - (13 - 10).
        EXPECT_NEAR(sim.world().get<Transform>(ball).position.x(), 7, 1e-5);
        EXPECT_EQ(sim.world().get<Transform>(ball).position.y(), 30);
    }
}

// A body that rests on nothing must not stay in the air because it once lay on something under
// another gravity.
TEST(AnotherSimulation, OfTheSameWorldLooksAtWhatRestsAgain) {
    World world;
    makeBody(world, {0, 0}, {.isStatic = true}, {100, 2});
    const Entity box = makeBody(world, {0, 2}, {}, {2, 2});
    const SimulationConfig down{.law = Law::Continuous,
                                .step = {.gravity = {0, -100}, .restitution = 0}};
    Simulation sim(std::move(world), down);
    sim.run(60);
    ASSERT_EQ(sim.world().get<Transform>(box).position.y(), 2) << "it rests on the floor";
    SimulationConfig up = down;
    up.step.gravity = {0, 100};
    Simulation other(sim.world().clone(), up);
    other.run(60);
    EXPECT_NEAR(other.world().get<Transform>(box).position.y(), 2 + 50, 1e-9);
}

TEST(StepCount, ThatTimesCannotTellApartIsRefused) {
    Simulation sim(crowd(), {});
    const std::uint64_t most = std::uint64_t{1} << 53;
    EXPECT_NO_THROW(sim.resumeAt(most));
    EXPECT_THROW(sim.resumeAt(most + 1), Error);
    Snapshot snapshot = sim.snapshot();
    snapshot.stepsDone = most + 1;
    EXPECT_THROW(sim.restore(snapshot), Error);
}

}  // namespace
}  // namespace quadrille
