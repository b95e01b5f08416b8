#include "app/window/picking.hpp"

#include <gtest/gtest.h>

namespace quadrille::app {
namespace {

Entity add(World& world, const Vec2& position, const Vec2& size, bool isStatic = false) {
    const Entity entity = world.create();
    world.add(entity, Transform{position}, BoxCollider{size}, PhysicsBody{.isStatic = isStatic},
              RectangleRenderer{});
    return entity;
}

TEST(Picking, FindsTheBodyUnderAPlace) {
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        World world;
        const Entity wide = add(world, {0, 0}, {20, 2});
        const Entity wall = add(world, {50, 0}, {10, 10}, true);
        world.setPrecision(precision);
        EXPECT_EQ(bodyAt(world, {9.5, 0.5}, 0), wide);
        EXPECT_EQ(bodyAt(world, {9.5, 1.5}, 0), std::nullopt);
        EXPECT_EQ(bodyAt(world, {46, 4}, 0), wall);
    }
}

TEST(Picking, TakesTheNearestWithinItsTolerance) {
    World world;
    add(world, {0, 0}, {2, 2});
    const Entity near = add(world, {10, 0}, {2, 2});
    EXPECT_EQ(bodyAt(world, {6, 0}, 3), near);
    EXPECT_EQ(bodyAt(world, {6, 0}, 2.9), std::nullopt);
}

TEST(Picking, OfBodiesOnEachOtherTakesTheOneDrawnLast) {
    World world;
    const Entity lower = add(world, {0, 0}, {4, 4});
    const Entity upper = add(world, {1, 0}, {4, 4});
    add(world, {0, 0}, {100, 100}, true);  // static bodies are drawn below
    EXPECT_EQ(bodyAt(world, {0, 0}, 1), upper);
    EXPECT_EQ(bodyAt(world, {-1.5, 0}, 0), lower);
}

TEST(Picking, PassesOverWhatIsNotDrawn) {
    World world;
    const Entity hidden = add(world, {0, 0}, {4, 4});
    world.remove<RectangleRenderer>(hidden);
    EXPECT_EQ(bodyAt(world, {0, 0}, 1), std::nullopt);
}

}  // namespace
}  // namespace quadrille::app
