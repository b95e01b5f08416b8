#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/creation_ranks.hpp>
#include <quadrille/state_hash.hpp>
#include <quadrille/world.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

struct Health {
    int points = 0;
};

std::vector<std::uint32_t> movingEntities(const World& world) {
    return world.visitBodies([](const auto& bodies) {
        return std::vector<std::uint32_t>(bodies.moving.entity.begin(), bodies.moving.entity.end());
    });
}

TEST(Body, FormsWhenAllThreeComponentsArePresentInAnyOrder) {
    std::array<int, 3> order{0, 1, 2};
    do {
        World world;
        const Entity e = world.create();
        for (const int part : order) {
            EXPECT_FALSE(world.isBody(e));
            if (part == 0) world.add(e, Transform{{3, 4}});
            if (part == 1) world.add(e, BoxCollider{{5, 6}});
            if (part == 2) world.add(e, PhysicsBody{.velocity = {7, 8}, .mass = 9});
        }
        ASSERT_TRUE(world.isBody(e));
        EXPECT_EQ(world.movingCount(), 1u);
        EXPECT_EQ(world.get<Transform>(e).position, Vec2(3, 4));
        EXPECT_EQ(world.get<BoxCollider>(e).size, Vec2(5, 6));
        EXPECT_EQ(world.get<PhysicsBody>(e).velocity, Vec2(7, 8));
        EXPECT_EQ(world.get<PhysicsBody>(e).mass, 9);
    } while (std::next_permutation(order.begin(), order.end()));
}

template <class Removed, class Kept1, class Kept2>
void expectDissolvesWithout() {
    World world;
    const Entity e = makeBody(world, {3, 4}, {.velocity = {7, 8}, .mass = 9});
    const Entity other = makeBody(world, {30, 40});
    world.remove<Removed>(e);
    EXPECT_FALSE(world.isBody(e));
    EXPECT_FALSE(world.has<Removed>(e));
    EXPECT_TRUE(world.has<Kept1>(e));
    EXPECT_TRUE(world.has<Kept2>(e));
    EXPECT_EQ(world.movingCount(), 1u);
    EXPECT_EQ(world.get<Transform>(other).position, Vec2(30, 40));
    if (world.has<Transform>(e)) {
        EXPECT_EQ(world.get<Transform>(e).position, Vec2(3, 4));
    }
    if (world.has<PhysicsBody>(e)) {
        EXPECT_EQ(world.get<PhysicsBody>(e).mass, 9);
    }
    world.add(e, Removed{});
    EXPECT_TRUE(world.isBody(e));
    EXPECT_EQ(world.movingCount(), 2u);
}

TEST(Body, DissolvesWhenAComponentIsRemovedAndKeepsTheOthers) {
    expectDissolvesWithout<Transform, BoxCollider, PhysicsBody>();
    expectDissolvesWithout<BoxCollider, Transform, PhysicsBody>();
    expectDissolvesWithout<PhysicsBody, Transform, BoxCollider>();
}

TEST(Body, AddingAllThreeReplacesWhatWasThereAndTakesOtherComponentsAlong) {
    World world;
    const Entity e = world.create();
    world.add(e, Transform{{1, 1}});
    world.add(e, PhysicsBody{}, Health{5}, Transform{{2, 2}}, BoxCollider{});
    EXPECT_EQ(world.get<Health>(e).points, 5);
    EXPECT_EQ(world.get<Transform>(e).position, Vec2(2, 2));
    world.add(e, Transform{{3, 3}}, BoxCollider{}, PhysicsBody{.mass = 2});
    EXPECT_EQ(world.movingCount(), 1u);
    EXPECT_EQ(world.get<Transform>(e).position, Vec2(3, 3));
    EXPECT_EQ(world.get<PhysicsBody>(e).mass, 2);
}

TEST(Body, OrderOfCreationIsKeptWhenBodiesInTheMiddleAreDestroyed) {
    World world;
    std::vector<Entity> e;
    for (int i = 0; i < 8; ++i) e.push_back(makeBody(world, {double(i), 0}, {.mass = 1.0 + i}));
    const Entity wallA = makeBody(world, {-1, 0}, {.isStatic = true});
    const Entity wallB = makeBody(world, {-2, 0}, {.isStatic = true});
    world.destroy(e[1]);
    world.destroy(wallA);
    world.destroy(e[4]);
    world.flush();
    EXPECT_EQ(movingEntities(world), (std::vector<std::uint32_t>{0, 2, 3, 5, 6, 7}));
    EXPECT_EQ(world.staticCount(), 1u);
    EXPECT_EQ(world.get<Transform>(wallB).position, Vec2(-2, 0));
    for (const int i : {0, 2, 3, 5, 6, 7}) {
        const Entity entity = e[static_cast<std::size_t>(i)];
        EXPECT_EQ(world.get<Transform>(entity).position.x(), i);
        EXPECT_EQ(world.get<PhysicsBody>(entity).mass, 1 + i);
    }
    const Entity reused = makeBody(world, {9, 0});
    EXPECT_LT(reused.index, 8u) << "an index is taken again, but the newest body stands last";
    EXPECT_EQ(movingEntities(world).back(), reused.index);
}

/// Taking a body out moves another one's row, which nobody must notice.
TEST(Body, OthersStayWhatTheyAreWhenBodiesInTheMiddleDissolveOrStopMoving) {
    World world;
    std::vector<Entity> e;
    for (int i = 0; i < 60; ++i) e.push_back(makeBody(world, {double(i), 0}, {.mass = 1.0 + i}));
    std::size_t moving = e.size(), fixed = 0;
    for (std::size_t i = 0; i < e.size(); ++i) {
        if (i % 3 == 0) world.remove<BoxCollider>(e[i]);
        if (i % 3 == 1) world.set(e[i], PhysicsBody{.isStatic = true});
        moving -= i % 3 != 2;
        fixed += i % 3 == 1;
        ASSERT_EQ(world.movingCount(), moving);
        ASSERT_EQ(world.staticCount(), fixed);
        ASSERT_EQ(world.validate(), std::vector<std::string>{});
    }
    for (std::size_t i = 0; i < e.size(); ++i) {
        EXPECT_EQ(world.get<Transform>(e[i]).position.x(), double(i));
        EXPECT_EQ(world.has<BoxCollider>(e[i]), i % 3 != 0);
        EXPECT_EQ(world.get<PhysicsBody>(e[i]).isStatic, i % 3 == 1);
        if (i % 3 == 2) {
            EXPECT_EQ(world.get<PhysicsBody>(e[i]).mass, 1.0 + double(i));
        }
    }
    world.visitBodies([](const auto& bodies) {
        const CreationRanks ranks(bodies.moving.created, bodies.moving.size());
        for (std::size_t place = 1; place < bodies.moving.size(); ++place) {
            EXPECT_LT(bodies.moving.entity[ranks.rowAt(place - 1)],
                      bodies.moving.entity[ranks.rowAt(place)]);
        }
    });
}

TEST(Body, HasItsMassAgainAfterItWasStatic) {
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        World world;
        const Entity e = makeBody(world, {3, 4}, {.velocity = {1, 0}, .mass = 5});
        const Entity wall = makeBody(world, {30, 40}, {.isStatic = true});
        const auto toggle = [](World& of, Entity entity) {
            PhysicsBody body = of.get<PhysicsBody>(entity);
            body.isStatic = !body.isStatic;
            body.velocity = {0, 0};
            of.set(entity, body);
        };
        toggle(world, e);
        world.setPrecision(precision);
        EXPECT_EQ(world.get<PhysicsBody>(e).mass, 5);
        EXPECT_EQ(world.get<PhysicsBody>(wall).mass, 1);
        toggle(world, e);
        EXPECT_EQ(world.get<PhysicsBody>(e).mass, 5);
        toggle(world, e);
        world.set(e, PhysicsBody{.mass = 7, .isStatic = true});
        World copy = world.clone();
        toggle(copy, e);
        EXPECT_EQ(copy.get<PhysicsBody>(e).mass, 7);
        world.set(e, PhysicsBody{.mass = 0, .isStatic = true});
        toggle(world, e);
        EXPECT_EQ(world.get<PhysicsBody>(e).mass, 1) << "0 is no mass that could come back";
    }
}

TEST(Body, SwitchesBetweenStaticAndMoving) {
    World world;
    const Entity e = makeBody(world, {3, 4}, {.velocity = {1, 0}, .mass = 5});
    makeBody(world, {30, 40});
    world.set(e, PhysicsBody{.isStatic = true});
    EXPECT_EQ(world.movingCount(), 1u);
    EXPECT_EQ(world.staticCount(), 1u);
    EXPECT_TRUE(world.get<PhysicsBody>(e).isStatic);
    EXPECT_EQ(world.get<PhysicsBody>(e).velocity, Vec2(0, 0));
    EXPECT_EQ(world.get<Transform>(e).position, Vec2(3, 4));
    world.set(e, Transform{{5, 6}});
    world.set(e, BoxCollider{{7, 8}});
    world.set(e, PhysicsBody{.velocity = {2, 3}, .mass = 4});
    EXPECT_EQ(world.movingCount(), 2u);
    EXPECT_EQ(world.staticCount(), 0u);
    EXPECT_EQ(world.get<Transform>(e).position, Vec2(5, 6));
    EXPECT_EQ(world.get<BoxCollider>(e).size, Vec2(7, 8));
    EXPECT_EQ(world.get<PhysicsBody>(e).velocity, Vec2(2, 3));
    EXPECT_EQ(world.get<PhysicsBody>(e).mass, 4);
}

TEST(Body, SizesAndMassesThatAllShareAreOneNumberUntilOneDiffers) {
    World world;
    std::vector<Entity> e;
    for (int i = 0; i < 3; ++i) e.push_back(makeBody(world, {double(i), 0}, {.mass = 5}));
    {
        const auto m = world.bodies<double>().moving;
        EXPECT_TRUE(m.halfWidth.uniform() && m.halfHeight.uniform() && m.mass.uniform());
        EXPECT_EQ(m.halfWidth.common, 1);
        EXPECT_EQ(m.halfHeight.common, 2);
        EXPECT_EQ(m.mass.common, 5);
    }
    world.set(e[1], BoxCollider{{2, 6}});
    world.set(e[2], PhysicsBody{.mass = 7});
    const auto m = world.bodies<double>().moving;
    EXPECT_TRUE(m.halfWidth.uniform());
    EXPECT_FALSE(m.halfHeight.uniform());
    EXPECT_FALSE(m.mass.uniform());
    EXPECT_EQ(world.get<BoxCollider>(e[0]).size, Vec2(2, 4));
    EXPECT_EQ(world.get<BoxCollider>(e[1]).size, Vec2(2, 6));
    EXPECT_EQ(world.get<PhysicsBody>(e[1]).mass, 5);
    EXPECT_EQ(world.get<PhysicsBody>(e[2]).mass, 7);
}

TEST(Body, EveryEditFromOutsideChangesTheRevision) {
    World world;
    auto revision = world.bodies<double>().revision;
    const auto expectNew = [&](const char* what) {
        EXPECT_NE(world.bodies<double>().revision, revision) << what;
        revision = world.bodies<double>().revision;
    };
    const Entity e = makeBody(world, {0, 0});
    expectNew("created");
    world.set(e, Transform{{1, 1}});
    expectNew("moved");
    world.set(e, BoxCollider{{3, 3}});
    expectNew("resized");
    world.set(e, PhysicsBody{.mass = 2});
    expectNew("other mass");
    world.set(e, PhysicsBody{.isStatic = true});
    expectNew("made static");
    world.remove<Transform>(e);
    expectNew("dissolved");
    world.add(e, Transform{});
    expectNew("formed");
    world.destroy(e);
    world.flush();
    expectNew("destroyed");
}

// ---- precision

TEST(Precision, RoundTripKeepsValuesThatFloatHolds) {
    World world;
    const Entity wall = makeBody(world, {-8, 0.25}, {.isStatic = true}, {0.5, 100});
    const Entity a = makeBody(world, {0.5, -3}, {.velocity = {0.125, 60}, .mass = 1.5});
    const Entity b = makeBody(world, {1024, 7}, {.mass = 2}, {3, 5});
    const auto hash = stateHash(world);
    world.setPrecision(Precision::Float);
    EXPECT_EQ(world.precision(), Precision::Float);
    EXPECT_THROW(world.bodies<double>(), Error);
    EXPECT_EQ(world.bodies<float>().size(), 3u);
    EXPECT_EQ(world.get<PhysicsBody>(a).mass, 1.5);
    EXPECT_EQ(world.get<Transform>(wall).position, Vec2(-8, 0.25));
    world.setPrecision(Precision::Double);
    EXPECT_THROW(world.bodies<float>(), Error);
    EXPECT_EQ(stateHash(world), hash);
    EXPECT_EQ(world.get<PhysicsBody>(a).velocity, Vec2(0.125, 60));
    EXPECT_EQ(world.get<BoxCollider>(b).size, Vec2(3, 5));
    EXPECT_EQ(world.get<BoxCollider>(wall).size, Vec2(0.5, 100));
}

TEST(Precision, NarrowingRoundsToNearest) {
    World world;
    const Entity e = makeBody(world, {0.1, 1.0 / 3});
    world.setPrecision(Precision::Float);
    EXPECT_EQ(world.get<Transform>(e).position, Vec2(0.1f, 1.0f / 3));
}

TEST(Precision, ValuesThatDoNotFitFloatAreRefusedAndTheWorldStaysAsItIs) {
    struct Case {
        const char* word;
        Vec2 position{0, 0};
        PhysicsBody body{};
        Vec2 size{1, 1};
    };
    for (const Case& c :
         {Case{.word = "position", .position = {1e39, 0}},
          Case{.word = "position", .position = {0, -1e39}, .body = {.isStatic = true}},
          Case{.word = "velocity", .body = {.velocity = {0, 1e39}}},
          Case{.word = "mass", .body = {.mass = 1e39}},
          Case{.word = "mass", .body = {.mass = 1e-60}}, Case{.word = "size", .size = {1e-60, 1}},
          Case{.word = "size", .body = {.isStatic = true}, .size = {1, 1e39}}}) {
        SCOPED_TRACE(c.word);
        World world;
        makeBody(world, {1, 1});
        makeBody(world, c.position, c.body, c.size);
        const auto hash = stateHash(world);
        const std::string error = errorOf([&] { world.setPrecision(Precision::Float); });
        EXPECT_EQ(error.find(std::string("entity 1: ") + c.word), 0u) << error;
        EXPECT_EQ(world.precision(), Precision::Double);
        EXPECT_EQ(stateHash(world), hash);
        EXPECT_EQ(world.movingCount() + world.staticCount(), 2u);
    }
}

}  // namespace
}  // namespace quadrille
