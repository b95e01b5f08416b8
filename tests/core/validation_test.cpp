#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include <quadrille/world.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

struct Health {
    int points = 0;
};

constexpr double tiny = std::numeric_limits<double>::denorm_min();

struct Impossible {
    std::string words;
    Transform transform{{1, 2}};
    BoxCollider collider{{3, 4}};
    PhysicsBody body{.velocity = {5, 6}, .mass = 7};
};

std::vector<Impossible> impossibleValues() {
    std::vector<Impossible> values;
    for (const double bad : {nan, infinity, -infinity}) {
        values.push_back({.words = "position is not finite", .transform = {{bad, 0}}});
        values.push_back({.words = "position is not finite", .transform = {{0, bad}}});
        values.push_back({.words = "size is not finite", .collider = {{bad, 1}}});
        values.push_back({.words = "size is not finite", .collider = {{1, bad}}});
        values.push_back({.words = "velocity is not finite", .body = {.velocity = {bad, 0}}});
        values.push_back({.words = "velocity is not finite", .body = {.velocity = {0, bad}}});
    }
    for (const double bad : {0.0, -0.0, -1.0, -tiny}) {
        values.push_back({.words = "size must be positive", .collider = {{bad, 1}}});
        values.push_back({.words = "size must be positive", .collider = {{1, bad}}});
    }
    for (const double bad : {nan, infinity, 0.0, -1.0, -tiny}) {
        values.push_back({.words = "mass must be finite and positive", .body = {.mass = bad}});
    }
    values.push_back(
        {.words = "a static body has no velocity", .body = {.velocity = {1, 0}, .isStatic = true}});
    return values;
}

TEST(Validation, ImpossibleNewBodyIsRefusedByNameAndNothingIsAdded) {
    for (const Impossible& bad : impossibleValues()) {
        SCOPED_TRACE(bad.words);
        World world;
        makeBody(world, {0, 0});
        const Entity e = world.create();
        const std::string error =
            errorOf([&] { world.add(e, bad.transform, bad.collider, bad.body, Health{1}); });
        EXPECT_EQ(error, "entity 1: " + bad.words);
        EXPECT_FALSE(world.has<Transform>(e));
        EXPECT_FALSE(world.has<BoxCollider>(e));
        EXPECT_FALSE(world.has<PhysicsBody>(e));
        EXPECT_FALSE(world.has<Health>(e));
        EXPECT_EQ(world.movingCount(), 1u);
    }
}

TEST(Validation, ImpossibleEditIsRefusedByNameAndNothingIsChanged) {
    for (const Impossible& bad : impossibleValues()) {
        SCOPED_TRACE(bad.words);
        World world;
        const Impossible good;
        const Entity e = world.create();
        world.add(e, good.transform, good.collider, good.body);
        const std::string error =
            errorOf([&] { world.add(e, bad.transform, bad.collider, bad.body); });
        EXPECT_EQ(error, "entity 0: " + bad.words);
        EXPECT_EQ(world.get<Transform>(e).position, good.transform.position);
        EXPECT_EQ(world.get<BoxCollider>(e).size, good.collider.size);
        EXPECT_EQ(world.get<PhysicsBody>(e).velocity, good.body.velocity);
        EXPECT_EQ(world.get<PhysicsBody>(e).mass, good.body.mass);
    }
}

TEST(Validation, MassOfAStaticBodyIsIgnored) {
    World world;
    EXPECT_NO_THROW(makeBody(world, {0, 0}, {.mass = 0, .isStatic = true}));
    EXPECT_NO_THROW(makeBody(world, {0, 0}, {.mass = nan, .isStatic = true}));
    EXPECT_EQ(world.staticCount(), 2u);
}

/// A world of floats with one moving body at (1, 2), size (3, 4), mass 7, velocity (5, 6).
class FloatWorld : public testing::Test {
  protected:
    void SetUp() override {
        world.setPrecision(Precision::Float);
        body = makeBody(world, {1, 2}, {.velocity = {5, 6}, .mass = 7}, {3, 4});
    }
    void expectUnchanged() const {
        ASSERT_TRUE(world.isBody(body));
        EXPECT_EQ(world.movingCount(), 1u);
        EXPECT_EQ(world.staticCount(), 0u);
        EXPECT_EQ(world.get<Transform>(body).position, Vec2(1, 2));
        EXPECT_EQ(world.get<BoxCollider>(body).size, Vec2(3, 4));
        EXPECT_EQ(world.get<PhysicsBody>(body).velocity, Vec2(5, 6));
        EXPECT_EQ(world.get<PhysicsBody>(body).mass, 7);
    }

    World world;
    Entity body;
};

TEST_F(FloatWorld, EditThatDoesNotFitNamesEntityAndValue) {
    const std::string error = errorOf([&] { world.set(body, Transform{{1e39, 0}}); });
    EXPECT_NE(error.find("entity 0"), std::string::npos) << error;
    EXPECT_NE(error.find("position"), std::string::npos) << error;
    expectUnchanged();
}

TEST_F(FloatWorld, EditOfSeveralComponentsThatDoesNotFitChangesNoneOfThem) {
    EXPECT_THROW(world.add(body, Transform{{9, 9}}, BoxCollider{{1e39, 1}}), Error);
    expectUnchanged();
    EXPECT_THROW(world.add(body, Transform{{9, 9}}, BoxCollider{{9, 9}}, PhysicsBody{.mass = 1e39}),
                 Error);
    expectUnchanged();
}

TEST_F(FloatWorld, NewBodyThatDoesNotFitLeavesTheEntityAsItWas) {
    const Entity e = world.create();
    EXPECT_THROW(world.add(e, Transform{{1e39, 0}}, BoxCollider{}, PhysicsBody{}), Error);
    EXPECT_FALSE(world.has<Transform>(e));
    world.add(e, Transform{{8, 8}}, BoxCollider{{2, 2}});
    EXPECT_THROW(world.add(e, Transform{}, BoxCollider{}, PhysicsBody{.mass = 1e39}), Error);
    ASSERT_TRUE(world.has<Transform>(e));
    EXPECT_EQ(world.get<Transform>(e).position, Vec2(8, 8));
    EXPECT_THROW(world.add(e, PhysicsBody{.mass = 1e39}), Error);
    EXPECT_FALSE(world.has<PhysicsBody>(e));
    expectUnchanged();
}

TEST_F(FloatWorld, StaticBodyThatCannotMoveStaysStatic) {
    const Entity wall = makeBody(world, {3, 3}, {.isStatic = true});
    EXPECT_THROW(world.set(wall, PhysicsBody{.mass = 1e39}), Error);
    ASSERT_TRUE(world.isBody(wall));
    EXPECT_TRUE(world.get<PhysicsBody>(wall).isStatic);
    EXPECT_EQ(world.staticCount(), 1u);
}

}  // namespace
}  // namespace quadrille
