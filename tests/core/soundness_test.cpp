// World::validate names each kind of damage. What is damaged here cannot be reached through the
// interface; files can hold it.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include <quadrille/simulation.hpp>
#include <quadrille/world.hpp>

#include "core/world_access.hpp"
#include "support.hpp"

namespace quadrille {
namespace {

/// Entities: moving bodies 0 to 3, static ones 4 and 5, a marker 6, a free one 7, a destroyed
/// one 8.
World sound() {
    World world;
    for (int i = 0; i < 4; ++i) makeBody(world, {10.0 * i, 0}, {.mass = 1.0 + i}, {2.0 + i, 2});
    makeBody(world, {0, 50}, {.isStatic = true});
    makeBody(world, {0, -50}, {.isStatic = true});
    world.add(world.create("marker"), Transform{{1, 2}});
    const Entity free = world.create();
    const Entity destroyed = world.create();
    world.destroy(free);
    world.flush();
    world.destroy(destroyed);
    return world;
}

using Doubles = BodyStore::Columns<double>;

/// Puts the columns back as `change` leaves them.
void damage(World& world, const std::function<void(Doubles&)>& change) {
    BodyStore& store = WorldAccess::store(world);
    BodyStore::AnyColumns columns = store.columns();
    change(std::get<Doubles>(columns));
    store.replace(std::move(columns), Edits::Everything, {});
}

bool names(const World& world, const std::string& words) {
    const auto findings = world.validate();
    return std::any_of(findings.begin(), findings.end(), [&](const std::string& finding) {
        return finding.find(words) != std::string::npos;
    });
}

std::string listed(const World& world) {
    std::string text;
    for (const std::string& finding : world.validate()) text += finding + "; ";
    return text;
}

TEST(Soundness, OfAWorldMadeThroughTheInterface) {
    EXPECT_EQ(listed(World{}), "");
    World world = sound();
    EXPECT_EQ(listed(world), "");
    world.flush();
    EXPECT_EQ(listed(world), "");
    WorldAccess::permute(world, std::vector<std::uint32_t>{2, 0, 3, 1},
                         std::vector<std::uint32_t>{1, 0});
    EXPECT_EQ(listed(world), "");
    world.destroy(world.at(2));
    world.flush();
    makeBody(world, {90, 0});
    EXPECT_EQ(listed(world), "");
    world.setPrecision(Precision::Float);
    EXPECT_EQ(listed(world), "");
}

TEST(Soundness, OfAWorldInTheMiddleOfARun) {
    for (const Law law : {Law::Baseline, Law::Impulse, Law::Continuous}) {
        Simulation sim(crowd(), {.law = law, .step = {.gravity = {0, -20}}});
        sim.run(5);
        EXPECT_EQ(listed(sim.world()), "");
    }
}

struct Damage {
    std::string words;  // of the finding
    std::function<void(World&)> make;
};

std::ostream& operator<<(std::ostream& out, const Damage& d) { return out << d.words; }

Damage inColumns(std::string words, std::function<void(Doubles&)> change) {
    return {std::move(words), [change](World& world) { damage(world, change); }};
}

template <class Change>
Damage inTables(std::string words, Change change) {
    return {std::move(words), [change](World& world) { change(WorldAccess::tables(world)); }};
}

const Damage damages[] = {
    // Values
    {"entity 1: position is not finite",
     [](World& world) {
         world.editBodies([](const auto& bodies) {
             using Real = std::remove_cvref_t<decltype(bodies.moving.x[0])>;
             bodies.moving.x[1] = static_cast<Real>(nan);
         });
     }},
    {"entity 2: velocity is not finite",
     [](World& world) {
         world.editBodies([](const auto& bodies) {
             using Real = std::remove_cvref_t<decltype(bodies.moving.x[0])>;
             bodies.moving.vy[2] = static_cast<Real>(infinity);
         });
     }},
    inColumns("entity 0: position is not finite", [](Doubles& c) { c.moving.y.set(0, -infinity); }),
    inColumns("entity 3: velocity is not finite", [](Doubles& c) { c.moving.vx.set(3, nan); }),
    inColumns("entity 0: size is not positive", [](Doubles& c) { c.moving.halfWidth.set(0, 0); }),
    inColumns("entity 1: size is not positive", [](Doubles& c) { c.moving.halfHeight.set(1, -1); }),
    inColumns("entity 2: size is not finite", [](Doubles& c) { c.moving.halfWidth.set(2, nan); }),
    inColumns("entity 3: mass is not positive", [](Doubles& c) { c.moving.mass.set(3, 0); }),
    inColumns("entity 3: mass is not finite", [](Doubles& c) { c.moving.mass.set(3, infinity); }),
    inColumns("entity 5: position is not finite", [](Doubles& c) { c.fixed.y.set(1, nan); }),
    inColumns("entity 4: size is not positive", [](Doubles& c) { c.fixed.halfHeight.set(0, 0); }),
    // Rows
    inColumns("columns of the moving bodies have different lengths",
              [](Doubles& c) { c.moving.vx.shrink(3); }),
    inColumns("columns of the moving bodies have different lengths",
              [](Doubles& c) { c.moving.mass.grow(); }),
    inColumns("columns of the moving bodies have different lengths",
              [](Doubles& c) {
                  c.moving.rests.store({0, 0, 0});
              }),
    inColumns("columns of the moving bodies have different lengths",
              [](Doubles& c) {
                  c.moving.created.store({0, 1, 2}, 4, 9);
              }),
    inColumns("columns of the static bodies have different lengths",
              [](Doubles& c) { c.fixed.entity.shrink(1); }),
    inColumns("a moving body of an entity that does not exist",
              [](Doubles& c) { c.moving.entity.set(0, 1000); }),
    inColumns("a static body of an entity that does not exist",
              [](Doubles& c) { c.fixed.entity.set(0, 1000); }),
    inColumns("entity 1 does not know its body", [](Doubles& c) { c.moving.entity.set(0, 1); }),
    // Order of creation
    inColumns("creation numbers of the moving bodies are not all different",
              [](Doubles& c) {
                  c.moving.created.store({0, 1, 1, 2}, 4, 4);
              }),
    inColumns("next creation number of the moving bodies is wrong",
              [](Doubles& c) {
                  c.moving.created.store({0, 1, 7, 2}, 4, 4);
              }),
    inColumns("creation numbers of the static bodies are not all different",
              [](Doubles& c) {
                  c.fixed.created.store({3, 3}, 2, 4);
              }),
    // The next body would get a number that is taken.
    inColumns("next creation number of the moving bodies is wrong",
              [](Doubles& c) { c.moving.created.store({}, 4, 2); }),
    // Entities
    inTables("tables of entities have different lengths", [](auto t) { t.dead.pop_back(); }),
    inTables("tables of entities have different lengths", [](auto t) { t.slots.push_back({}); }),
    inTables("entity 2 does not know its body", [](auto t) { t.slots[2] = BodyRef{}; }),
    inTables("does not know its body", [](auto t) { std::swap(t.slots[0], t.slots[1]); }),
    inTables("entity 6 has a body that does not exist",
             [](auto t) { t.slots[6] = BodyRef::moving(4); }),
    inTables("entity 6 has a body that does not exist",
             [](auto t) { t.slots[6] = BodyRef::fixed(2); }),
    inTables("entity 6 has the body of another one",
             [](auto t) { t.slots[6] = BodyRef::moving(0); }),
    inTables("entity 2 is lost", [](auto t) { t.dead[2] = true; }),
    inTables("a free entity that does not exist", [](auto t) { t.free.push_back(99); }),
    inTables("entity 7 is free twice", [](auto t) { t.free.push_back(7); }),
    inTables("entity 0 is alive and free", [](auto t) { t.free.push_back(0); }),
    inTables("a destroyed entity that does not exist",
             [](auto t) {
                 t.condemned.push_back({99, 0});
             }),
    inTables("number of living entities is wrong", [](auto t) { ++t.alive; }),
    {"entity 3 is free and has a body",
     [](World& world) {
         const auto t = WorldAccess::tables(world);
         t.dead[3] = true;
         t.free.push_back(3);
         --t.alive;
     }},
    {"a component of entity 99",
     [](World& world) {
         WorldAccess::pool<Transform>(world).put({99, 0}, {});
     }},
    {"a component of entity 7",
     [](World& world) {
         const auto generation = WorldAccess::tables(world).generations[7];
         WorldAccess::pool<RectangleRenderer>(world).put({7, generation}, {});
     }},
    {"entity 2 has a component twice",
     [](World& world) {
         WorldAccess::pool<PhysicsBody>(world).put({2, 0}, {});
     }},
    {"a component of entity 6",
     [](World& world) {
         WorldAccess::pool<BoxCollider>(world).put({6, 5}, {});
     }},
};

class Damaged : public testing::TestWithParam<Damage> {};
INSTANTIATE_TEST_SUITE_P(Soundness, Damaged, testing::ValuesIn(damages));

TEST_P(Damaged, IsNamed) {
    World world = sound();
    ASSERT_EQ(listed(world), "");
    GetParam().make(world);
    EXPECT_TRUE(names(world, GetParam().words)) << listed(world);
    const World copy = world.clone();
    EXPECT_TRUE(names(copy, GetParam().words)) << "a clone is no sounder";
}

TEST(Soundness, ManyFindingsEndInAFew) {
    for (const std::size_t wrong : {20, 21, 50}) {
        World world = crowd(1, 60);
        world.editBodies([&](const auto& bodies) {
            for (std::size_t i = 0; i < wrong; ++i) {
                bodies.moving.x[i] = std::numeric_limits<float>::quiet_NaN();
            }
        });
        const auto findings = world.validate();
        ASSERT_EQ(findings.size(), std::min<std::size_t>(wrong, 21));
        EXPECT_EQ(findings.back() == "and more", wrong > 20);
    }
}

}  // namespace
}  // namespace quadrille
