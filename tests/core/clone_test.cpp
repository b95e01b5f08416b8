// World::clone: the same world twice, each on its own from there on.

#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include <quadrille/names.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/state_hash.hpp>
#include <quadrille/world.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

struct Health {
    int points = 0;
};
struct Owner {
    std::unique_ptr<int> value;
};

static_assert(!std::is_copy_constructible_v<World>, "a copy is dear and has a name");
static_assert(!std::is_copy_assignable_v<World>);

TEST(Clone, HasAllThatTheWorldHas) {
    World world({.size = {300, 200}, .seed = 5});
    const Entity body = makeBody(world, {1, 2}, {.velocity = {3, 4}, .mass = 5}, {6, 7});
    const Entity wall = makeBody(world, {8, 9}, {.isStatic = true});
    const Entity marker = world.create("marker");
    world.add(marker, Transform{{1.5, 2.5}}, Health{7});
    const Entity gone = world.create();
    const Entity condemned = makeBody(world, {50, 50});
    world.destroy(gone);
    world.flush();
    world.destroy(condemned);

    const World copy = std::as_const(world).clone();
    EXPECT_EQ(copy.config().size, Vec2(300, 200));
    EXPECT_EQ(copy.config().seed, 5u);
    EXPECT_EQ(copy.entityCount(), 3u);
    EXPECT_EQ(copy.get<Transform>(body).position, Vec2(1, 2));
    EXPECT_EQ(copy.get<BoxCollider>(body).size, Vec2(6, 7));
    EXPECT_EQ(copy.get<PhysicsBody>(body).velocity, Vec2(3, 4));
    EXPECT_EQ(copy.get<PhysicsBody>(body).mass, 5);
    EXPECT_TRUE(copy.get<PhysicsBody>(wall).isStatic);
    EXPECT_EQ(copy.find("marker"), marker);
    EXPECT_EQ(copy.get<Health>(marker).points, 7);
    EXPECT_EQ(copy.get<Transform>(marker).position, Vec2(1.5, 2.5));
    EXPECT_FALSE(copy.alive(gone));
    EXPECT_FALSE(copy.alive(condemned));
    EXPECT_EQ(copy.movingCount(), 2u) << "until the next flush";
    EXPECT_EQ(copy.validate(), std::vector<std::string>{});
}

TEST(Clone, IsIndependentAfterwards) {
    World world;
    const Entity body = makeBody(world, {1, 2}, {.velocity = {3, 4}});
    world.add(body, Health{1});
    World copy = world.clone();
    copy.set(body, Transform{{9, 9}});
    copy.get<Health>(body).points = 2;
    makeBody(copy, {30, 30});
    EXPECT_EQ(world.get<Transform>(body).position, Vec2(1, 2));
    EXPECT_EQ(world.get<Health>(body).points, 1);
    EXPECT_EQ(world.movingCount(), 1u);
    world.destroy(body);
    world.flush();
    EXPECT_TRUE(copy.alive(body));
    EXPECT_EQ(copy.get<Transform>(body).position, Vec2(9, 9));
    world = World{};
    EXPECT_EQ(copy.get<Health>(body).points, 2);
}

TEST(Clone, GoesOnWithTheSameIdsAndRandomNumbers) {
    World world;
    for (int i = 0; i < 9; ++i) makeBody(world, {double(i), 0});
    for (const std::uint32_t index : {5u, 2u, 7u}) world.destroy(world.at(index));
    world.random().uniform(0, 1);
    World copy = world.clone();
    for (int round = 0; round < 5; ++round) {
        EXPECT_EQ(world.random().integer(0, 1'000'000), copy.random().integer(0, 1'000'000));
        if (round == 1) {
            world.flush();
            copy.flush();
        }
        EXPECT_EQ(world.create(), copy.create());
    }
}

TEST(Clone, GoesOnWithTheSameBitsInTheMiddleOfARun) {
    for (const Law law : {Law::Baseline, Law::Impulse, Law::Continuous}) {
        for (const Precision precision : {Precision::Double, Precision::Float}) {
            SCOPED_TRACE(std::string(name(law)) + ", " + std::string(name(precision)));
            const SimulationConfig config{.partitioner = Quadtree{},
                                          .law = law,
                                          .precision = precision,
                                          .step = {.gravity = {0, -30}, .restitution = 0.9}};
            Simulation sim(crowd(3, 150), config);
            sim.run(10);
            Simulation other(std::as_const(sim).world().clone(), config);
            other.resumeAt(10);
            EXPECT_EQ(other.world().precision(), precision);
            for (int i = 0; i < 15; ++i) {
                sim.step();
                other.step();
                ASSERT_EQ(stateHash(other.world()), stateHash(sim.world())) << "step " << i;
            }
        }
    }
}

TEST(Clone, OfComponentsThatCannotBeCopiedIsAnErrorThatNamesTheType) {
    World world;
    const Entity e = makeBody(world, {1, 2});
    world.add(e, Owner{std::make_unique<int>(3)});
    const std::string error = errorOf([&] { world.clone(); });
    EXPECT_NE(error.find("Owner"), std::string::npos) << error;
    EXPECT_EQ(*world.get<Owner>(e).value, 3) << "nothing happens to the world";
}

TEST(Clone, OfAWorldThatWasMovedFromIsAnError) {
    World world;
    const World taken = std::move(world);
    EXPECT_THROW(world.clone(), Error);  // NOLINT: that is what is tested
}

}  // namespace
}  // namespace quadrille
