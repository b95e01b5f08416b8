// What is registered with a simulation can be taken out again, inside a call and outside.

#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/simulation.hpp>
#include <quadrille/snapshot.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

/// A ball that touches several boxes in every step.
Simulation touching(int boxes = 3) {
    World world;
    for (int i = 0; i < boxes; ++i) makeBody(world, {i * 1.5, 0}, {.mass = 1}, {2, 2});
    return Simulation(std::move(world), {.law = Law::Impulse});
}

TEST(Subscription, OfNothingIsNotActive) {
    Subscription none;
    EXPECT_FALSE(none.active());
    none.remove();
    EXPECT_FALSE(none.active());
}

TEST(Subscription, IsActiveUntilItIsRemoved) {
    Simulation sim(World{});
    int calls = 0;
    Subscription subscription = sim.onStep([&](const World&, const StepReport&) { ++calls; });
    EXPECT_TRUE(subscription.active());
    sim.run(3);
    EXPECT_EQ(calls, 3);
    subscription.remove();
    EXPECT_FALSE(subscription.active());
    sim.run(3);
    EXPECT_EQ(calls, 3);
    subscription.remove();
    sim.run(1);
    EXPECT_EQ(calls, 3);
}

TEST(Subscription, ThatIsThrownAwayLeavesTheListener) {
    Simulation sim(World{});
    int calls = 0;
    sim.addSystem([&](World&, double) { ++calls; });
    {
        const Subscription unused = sim.onStep([&](const World&, const StepReport&) { ++calls; });
    }
    sim.run(2);
    EXPECT_EQ(calls, 4);
}

TEST(Subscription, OutlivesTheSimulation) {
    Subscription subscription;
    {
        Simulation sim(World{});
        subscription = sim.onStep([](const World&, const StepReport&) {});
    }
    subscription.remove();
    EXPECT_FALSE(subscription.active());
}

TEST(Subscription, FollowsASimulationThatIsMoved) {
    Simulation sim(World{});
    int calls = 0;
    Subscription subscription = sim.addSystem([&](World&, double) { ++calls; });
    Simulation moved(std::move(sim));
    moved.run(2);
    subscription.remove();
    moved.run(2);
    EXPECT_EQ(calls, 2);
}

TEST(Subscription, RemovedBetweenStepsLeavesTheOthersInTheirOrder) {
    Simulation sim(World{});
    std::string order;
    std::vector<Subscription> all;
    for (const char c : {'a', 'b', 'c', 'd'}) {
        all.push_back(sim.addSystem([&order, c](World&, double) { order += c; }));
    }
    sim.step();
    all[1].remove();
    sim.step();
    all[0].remove();
    all[3].remove();
    sim.step();
    EXPECT_EQ(order, "abcdacdc");
}

TEST(Subscription, ASystemMayRemoveItselfAndOthersWhileItRuns) {
    Simulation sim(World{});
    std::string order;
    Subscription first, second, third;
    first = sim.addSystem([&](World&, double) {
        order += 'a';
        first.remove();
        second.remove();
    });
    second = sim.addSystem([&](World&, double) { order += 'b'; });
    third = sim.addSystem([&](World&, double) { order += 'c'; });
    sim.run(3);
    EXPECT_EQ(order, "accc") << "one that is removed is not called even in the same step";
}

TEST(Subscription, AContactListenerMayRemoveItselfInTheMiddleOfAStep) {
    Simulation sim = touching();
    int first = 0;
    int second = 0;
    Subscription subscription;
    subscription = sim.onContact([&](const Contact&) {
        ++first;
        subscription.remove();
    });
    sim.onContact([&](const Contact&) { ++second; });
    ASSERT_GE(sim.step().contacts, 2u);
    EXPECT_EQ(first, 1);
    EXPECT_GE(second, 2);
}

TEST(Subscription, AListenerMayAddAnother) {
    Simulation sim = touching();
    int added = 0;
    Subscription once = sim.onContact([&](const Contact&) {
        once.remove();
        for (int i = 0; i < 100; ++i) sim.onContact([&](const Contact&) { ++added; });
    });
    const auto contacts = static_cast<int>(sim.step().contacts);
    ASSERT_GE(contacts, 2);
    EXPECT_EQ(added, 100 * contacts) << "the new ones hear of the contact that is under way, too";
}

TEST(Reentry, IsRefusedAndTheStepGoesOn) {
    Simulation sim = touching();
    const Snapshot start = sim.snapshot();
    int refused = 0;
    const auto tryBoth = [&] {
        EXPECT_THROW(sim.step(), Error);
        EXPECT_THROW(sim.run(2), Error);
        EXPECT_THROW(sim.restore(start), Error);
        ++refused;
    };
    sim.addSystem([&](World&, double) { tryBoth(); });
    sim.onContact([&](const Contact&) { tryBoth(); });
    sim.onStep([&](const World&, const StepReport&) { tryBoth(); });
    const auto contacts = static_cast<int>(sim.step().contacts);
    ASSERT_GE(contacts, 2);
    EXPECT_EQ(refused, contacts + 2);
    EXPECT_EQ(sim.stepsDone(), 1u);
    EXPECT_NO_THROW(sim.restore(start));
}

TEST(Reentry, IsPossibleAgainAfterAListenerThrew) {
    Simulation sim = touching();
    Subscription thrower = sim.addSystem([](World&, double) { throw Error("no"); });
    EXPECT_THROW(sim.step(), Error);
    thrower.remove();
    EXPECT_NO_THROW(sim.step());
}

TEST(Subscription, WhatAListenerHeldIsSetFreeOnceItIsRemoved) {
    Simulation sim = touching();
    const auto held = std::make_shared<int>(1);
    Subscription system = sim.addSystem([held](World&, double) {});
    Subscription contact = sim.onContact([held](const Contact&) {});
    Subscription observer = sim.onStep([held](const World&, const StepReport&) {});
    sim.step();
    EXPECT_EQ(held.use_count(), 4);
    system.remove();
    contact.remove();
    observer.remove();
    sim.step();
    EXPECT_EQ(held.use_count(), 1);
}

TEST(Subscription, OfTheLastContactListenerMakesContactsCheapAgain) {
    Simulation sim = touching();
    EXPECT_FALSE(sim.features().listeners);
    Subscription subscription = sim.onContact([](const Contact&) {});
    EXPECT_TRUE(sim.features().listeners);
    subscription.remove();
    EXPECT_FALSE(sim.features().listeners);
    sim.step();
    EXPECT_THROW(sim.contacts(), Error);
}

}  // namespace
}  // namespace quadrille
