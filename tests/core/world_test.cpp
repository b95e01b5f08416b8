#include <array>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/world.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

struct Health {
    int points = 0;
};
struct Tag {};
struct Owner {
    std::unique_ptr<int> value;
};

// ---- entities

TEST(World, EntityLivesUntilItIsDestroyed) {
    World world;
    const Entity a = world.create();
    const Entity b = world.create();
    EXPECT_TRUE(world.alive(a));
    EXPECT_NE(a, b);
    EXPECT_EQ(world.entityCount(), 2u);
    world.destroy(a);
    EXPECT_FALSE(world.alive(a));
    EXPECT_TRUE(world.alive(b));
    EXPECT_EQ(world.entityCount(), 1u);
    EXPECT_FALSE(world.alive(Entity{}));
    EXPECT_EQ(world.at(b.index), b);
    EXPECT_EQ(world.at(a.index), Entity{});
    EXPECT_EQ(world.at(1000), Entity{});
}

TEST(World, IndexIsReusedWithANewGenerationOnlyAfterFlush) {
    World world;
    const Entity first = world.create();
    world.destroy(first);
    EXPECT_NE(world.create().index, first.index);
    world.flush();
    const Entity again = world.create();
    EXPECT_EQ(again.index, first.index);
    EXPECT_NE(again.generation, first.generation);
    EXPECT_TRUE(world.alive(again));
    EXPECT_FALSE(world.alive(first));
}

TEST(World, StaleHandleIsRefusedEverywhere) {
    World world;
    const Entity stale = world.create("old");
    world.destroy(stale);
    world.flush();
    const Entity current = makeBody(world, {1, 2});
    ASSERT_EQ(current.index, stale.index);

    EXPECT_THROW(world.add(stale, Health{1}), Error);
    EXPECT_THROW(world.set(stale, Transform{{9, 9}}), Error);
    EXPECT_THROW(world.get<Transform>(stale), Error);
    EXPECT_THROW(world.remove<Transform>(stale), Error);
    EXPECT_THROW(world.destroy(stale), Error);
    EXPECT_FALSE(world.has<Transform>(stale));
    EXPECT_FALSE(world.isBody(stale));
    EXPECT_EQ(world.name(stale), "");
    EXPECT_EQ(world.get<Transform>(current).position, Vec2(1, 2));
    EXPECT_NE(errorOf([&] { world.destroy(stale); }).find("entity 0"), std::string::npos);
}

TEST(World, DestroyedBodyVanishesForLookUpsAtOnceAndFromTheColumnsAtFlush) {
    World world;
    const Entity gone = makeBody(world, {1, 1});
    makeBody(world, {2, 2});
    world.destroy(gone);
    EXPECT_FALSE(world.has<Transform>(gone));
    EXPECT_THROW(world.get<PhysicsBody>(gone), Error);
    EXPECT_EQ(world.movingCount(), 2u);
    world.flush();
    EXPECT_EQ(world.movingCount(), 1u);
}

TEST(World, NamesAreFoundAmongTheLiving) {
    World world;
    const Entity a = world.create("ball");
    const Entity nameless = world.create();
    EXPECT_EQ(world.name(a), "ball");
    EXPECT_EQ(world.name(nameless), "");
    EXPECT_EQ(world.find("ball"), a);
    EXPECT_EQ(world.find("cube"), Entity{});
    world.set(a, Name{"cube"});
    EXPECT_EQ(world.find("cube"), a);
    const Entity b = world.create("cube");
    world.destroy(a);
    EXPECT_EQ(world.find("cube"), b);
    world.flush();
    EXPECT_EQ(world.find("cube"), b);
    EXPECT_EQ(world.find("ball"), Entity{});
}

// ---- components of other types

TEST(World, ComponentsAreAddedReplacedAndRemoved) {
    World world;
    const Entity e = world.create();
    EXPECT_FALSE(world.has<Health>(e));
    world.add(e, Health{3}, Tag{});
    EXPECT_TRUE(world.has<Tag>(e));
    world.get<Health>(e).points += 1;
    EXPECT_EQ(std::as_const(world).get<Health>(e).points, 4);
    world.add(e, Health{7});
    EXPECT_EQ(world.get<Health>(e).points, 7);
    world.remove<Health>(e);
    EXPECT_FALSE(world.has<Health>(e));
    EXPECT_TRUE(world.has<Tag>(e));
    EXPECT_NO_THROW(world.remove<Health>(e));
    EXPECT_NE(errorOf([&] { world.get<Health>(e); }).find("entity 0"), std::string::npos);
}

TEST(World, MoveOnlyComponentsAreStored) {
    World world;
    std::vector<Entity> entities;
    for (int i = 0; i < 5; ++i) {
        entities.push_back(world.create());
        world.add(entities.back(), Owner{std::make_unique<int>(i)});
    }
    world.remove<Owner>(entities[1]);
    world.destroy(entities[3]);
    world.flush();
    int sum = 0;
    world.each<Owner>([&](Entity, Owner& owner) { sum += *owner.value; });
    EXPECT_EQ(sum, 0 + 2 + 4);
    EXPECT_EQ(*world.get<Owner>(entities[4]).value, 4);
}

TEST(Pool, AgreesWithAMapUnderRandomUse) {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        std::mt19937 random(seed);
        Pool<std::string> pool;
        std::map<std::uint32_t, std::string> expected;
        for (int i = 0; i < 2000; ++i) {
            const Entity entity{static_cast<std::uint32_t>(random() % 64), 0};
            if (random() % 3 == 0) {
                pool.erase(entity.index);
                expected.erase(entity.index);
            } else {
                pool.put(entity, std::to_string(i));
                expected[entity.index] = std::to_string(i);
            }
            ASSERT_EQ(pool.size(), expected.size());
        }
        for (std::uint32_t index = 0; index < 70; ++index) {
            const auto found = expected.find(index);
            ASSERT_EQ(pool.contains(index), found != expected.end());
            if (found != expected.end()) {
                EXPECT_EQ(pool[index], found->second);
            }
        }
    }
}

// ---- each

TEST(Each, VisitsEntitiesThatHaveAllComponentsNewestOfTheSmallestPoolFirst) {
    World world;
    std::array<Entity, 4> e{};
    for (auto& entity : e) {
        entity = world.create();
        world.add(entity, Health{static_cast<int>(entity.index)});
    }
    world.add(e[2], Tag{});
    world.add(e[0], Tag{});
    const std::vector<Entity> expected{e[0], e[2]};
    std::vector<Entity> visited;
    world.each<Health, Tag>([&](Entity entity, Health& health, Tag&) {
        EXPECT_EQ(health.points, static_cast<int>(entity.index));
        visited.push_back(entity);
    });
    EXPECT_EQ(visited, expected);
    visited.clear();
    world.each<Tag, Health>([&](Entity entity, Tag&, Health&) { visited.push_back(entity); });
    EXPECT_EQ(visited, expected);
    world.each<Health, Owner>([](Entity, Health&, Owner&) { FAIL() << "nobody has an Owner"; });
}

TEST(Each, VisitsBodiesAndPooledBodyComponentsAlike) {
    World world;
    const Entity body = makeBody(world, {1, 1});
    const Entity marker = world.create();
    world.add(marker, Transform{{2, 2}}, Tag{});
    double sum = 0;
    world.each<Transform>([&](Entity, const Transform& t) { sum += t.position.x(); });
    EXPECT_EQ(sum, 3);
    world.add(body, Tag{});
    std::vector<Entity> visited;
    world.each<Tag, PhysicsBody>([&](Entity e, Tag&, const PhysicsBody&) { visited.push_back(e); });
    EXPECT_EQ(visited, std::vector<Entity>{body});
}

TEST(Each, MayDestroyAnyEntityAndPassesTheDeadOver) {
    World world;
    std::vector<Entity> entities;
    for (int i = 0; i < 10; ++i) {
        entities.push_back(world.create());
        world.add(entities.back(), Health{i});
    }
    std::vector<int> visited;
    world.each<Health>([&](Entity entity, Health& health) {
        visited.push_back(health.points);
        world.destroy(entity);
        if (health.points % 2 == 1) {
            world.destroy(entities[static_cast<std::size_t>(health.points - 1)]);
        }
    });
    EXPECT_EQ(visited, (std::vector<int>{9, 7, 5, 3, 1}));
    EXPECT_EQ(world.entityCount(), 0u);
    world.each<Health>([](Entity, Health&) { FAIL() << "all are dead"; });
}

TEST(Each, MayRemoveTheVisitedComponent) {
    World world;
    for (int i = 0; i < 10; ++i) world.add(world.create(), Health{i});
    std::vector<int> visited;
    world.each<Health>([&](Entity entity, Health& health) {
        visited.push_back(health.points);
        if (health.points % 3 != 0) world.remove<Health>(entity);
    });
    EXPECT_EQ(visited, (std::vector<int>{9, 8, 7, 6, 5, 4, 3, 2, 1, 0}));
    int left = 0;
    world.each<Health>([&](Entity, Health&) { ++left; });
    EXPECT_EQ(left, 4);
}

// ---- walls

TEST(World, WallsStandLeftRightBottomTopAndCoverTheCorners) {
    World world({.size = {640, 480}});
    const auto walls = world.addWalls({.thickness = 20, .inset = 10});
    const std::array<Vec2, 4> centres{Vec2(-320, 0), Vec2(320, 0), Vec2(0, -240), Vec2(0, 240)};
    const std::array<Vec2, 4> sizes{Vec2(20, 500), Vec2(20, 500), Vec2(660, 20), Vec2(660, 20)};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(world.get<Transform>(walls[i]).position, centres[i]) << i;
        EXPECT_EQ(world.get<BoxCollider>(walls[i]).size, sizes[i]) << i;
        EXPECT_TRUE(world.get<PhysicsBody>(walls[i]).isStatic) << i;
    }
    EXPECT_EQ(world.staticCount(), 4u);
}

TEST(World, ImpossibleWallsLeaveNothingBehind) {
    for (const WallsConfig& bad :
         {WallsConfig{.thickness = 0}, WallsConfig{.thickness = -1}, WallsConfig{.thickness = nan},
          WallsConfig{.thickness = infinity}, WallsConfig{.inset = 240}, WallsConfig{.inset = nan},
          WallsConfig{.inset = infinity}, WallsConfig{.thickness = 1e308}}) {
        SCOPED_TRACE(testing::Message() << bad.thickness << ' ' << bad.inset);
        World world({.size = {640, 480}});
        EXPECT_THROW(world.addWalls(bad), Error);
        EXPECT_EQ(world.entityCount(), 0u);
    }
}

TEST(World, ImpossibleSizeIsRefused) {
    for (const Vec2& bad : {Vec2(0, 1), Vec2(1, -1), Vec2(nan, 1), Vec2(1, infinity)}) {
        EXPECT_THROW(World({.size = bad}), Error) << bad.transpose();
    }
}

}  // namespace
}  // namespace quadrille
