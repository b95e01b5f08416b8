#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

#include <quadrille/quadrille.hpp>

#include "accuracy/metrics.hpp"
#include "reference/oracle.hpp"
#include "sanitized.hpp"

// The law `continuous` against the event-driven oracle, which shares no code with it: unequal sizes
// and masses, static boxes, gravity, restitution.

namespace quadrille {
namespace {

/// The first contact of bodies that are within so little of each other that rounding decides in
/// which order they collide from then on.
std::size_t collapseIn(const std::vector<Contact>& contacts) {
    const auto slow = std::find_if(contacts.begin(), contacts.end(), [](const Contact& c) {
        return c.approach.cwiseAbs().maxCoeff() < 0.1;
    });
    return static_cast<std::size_t>(slow - contacts.begin());
}

void compareWithOracle(std::uint64_t seed, const Vec2& gravity, double restitution, int steps,
                       std::size_t* untilCollapse = nullptr) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    World world({.size = {200, 150}});
    world.addWalls({.thickness = 20});
    std::vector<reference::Box> boxes;
    const auto add = [&](const Vec2& position, const Vec2& size, const Vec2& velocity, double mass,
                         bool isStatic) {
        const auto label = static_cast<std::uint32_t>(boxes.size());  // the entity's id
        boxes.push_back({position, velocity, size, mass, isStatic, label});
    };
    for (std::uint32_t i = 0; i < 4; ++i) {
        const Entity wall = world.at(i);
        add(world.get<Transform>(wall).position, world.get<BoxCollider>(wall).size, {0, 0}, 1,
            true);
    }
    // A lattice of places, each with a box that fits it.
    for (int row = 0; row < 9; ++row) {
        for (int column = 0; column < 12; ++column) {
            const Vec2 place(-90 + 15.0 * column, -66 + 15.0 * row);
            const Vec2 size(random.uniform(1, 12), random.uniform(1, 12));
            const bool isStatic = random.uniform(0, 1) < 0.05;
            const double mass = random.uniform(0, 1) < 0.5 ? 1 : random.uniform(0.1, 10);
            const Vec2 velocity =
                isStatic ? Vec2(0, 0) : Vec2(random.uniform(-30, 30), random.uniform(-30, 30));
            const Vec2 position = place + Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
            add(position, size, velocity, mass, isStatic);
            world.add(world.create(), Transform{position}, BoxCollider{size},
                      PhysicsBody{velocity, isStatic ? 1 : mass, isStatic});
        }
    }
    Simulation sim(std::move(world), {.partitioner = Quadtree{8, 6},
                                      .law = Law::Continuous,
                                      .step = {.gravity = gravity, .restitution = restitution}});
    std::vector<Contact> contacts;
    sim.onContact([&](const Contact& c) { contacts.push_back(c); });
    const double energy = totalEnergy(sim.world(), gravity);
    sim.run(static_cast<std::uint64_t>(steps));

    reference::Oracle oracle(boxes, gravity, restitution, reference::Ties::ByLabels);
    oracle.runUntil(sim.time());
    const auto& events = oracle.events();
    ASSERT_GT(events.size(), 50u);
    if (untilCollapse != nullptr) {
        // What happens at one instant may come in another order, by the last digit of its time.
        std::vector<reference::Event> measured;
        for (std::size_t k = 0; k < collapseIn(contacts); ++k) {
            const Contact& c = contacts[k];
            measured.push_back({c.time, c.numberA, c.numberB, static_cast<int>(c.axis)});
        }
        *untilCollapse += measured.size();
        ASSERT_EQ(accuracy::matchEvents(events, measured, 1e-9).matched, measured.size());
        return;
    }
    ASSERT_EQ(contacts.size(), events.size());
    for (std::size_t k = 0; k < events.size(); ++k) {
        SCOPED_TRACE("event " + std::to_string(k));
        ASSERT_NEAR(contacts[k].time, events[k].time, 1e-9);
        ASSERT_EQ(contacts[k].numberA, events[k].i);
        ASSERT_EQ(contacts[k].numberB, events[k].j);
        ASSERT_EQ(static_cast<int>(contacts[k].axis), events[k].axis);
    }
    if (restitution == 1) {
        // Potential energy has either sign, so its rounding is measured against its terms.
        double terms = totalEnergy(sim.world(), {0, 0});
        sim.world().visitBodies([&](const auto& bodies) {
            const auto& m = bodies.moving;
            for (std::size_t i = 0; i < m.size(); ++i) {
                terms += m.mass[i] * std::abs(gravity.x() * m.x[i] + gravity.y() * m.y[i]);
            }
        });
        EXPECT_NEAR(totalEnergy(sim.world(), gravity), energy, 1e-12 * terms);
    } else {
        EXPECT_LT(totalEnergy(sim.world(), gravity), energy);
    }
}

class ContinuousAgainstOracle : public testing::Test {
  protected:
    static void compare(const Vec2& gravity, double restitution, int steps) {
        std::random_device device;
        for (std::uint64_t i = 0; i < scenesOf(20); ++i) {
            compareWithOracle(device(), gravity, restitution, steps);
        }
        compareWithOracle(1, gravity, restitution, steps);
    }
};

TEST_F(ContinuousAgainstOracle, RandomScenes) { compare({0, 0}, 1, 60); }

TEST_F(ContinuousAgainstOracle, UnderGravity) {
    compare({0, -300}, 1, 40);
    compare({50, 80}, 1, 40);
}

TEST_F(ContinuousAgainstOracle, WithRestitutionBelowOne) {
    for (std::uint64_t seed = 1; seed <= scenesOf(20); ++seed) {
        compareWithOracle(seed, {0, 0}, 0.9, 60);
        compareWithOracle(seed, {0, -300}, 0.9, 30);
    }
}

// Bodies come to rest on others, and are hit there.
TEST_F(ContinuousAgainstOracle, WhereBodiesLieOnEachOther) {
    std::size_t compared = 0;
    for (std::uint64_t seed = 1; seed <= scenesOf(20); ++seed) {
        for (const double restitution : {0.0, 0.2, 0.5, 0.8}) {
            SCOPED_TRACE("restitution " + std::to_string(restitution));
            compareWithOracle(seed, {0, -300}, restitution, 80, &compared);
            if (HasFailure()) return;
        }
    }
    EXPECT_GT(compared, scenesOf(20) * 250);
}

}  // namespace
}  // namespace quadrille
