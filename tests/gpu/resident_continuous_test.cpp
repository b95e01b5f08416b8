// The law `continuous` on the resolver `cuda-resident` gives the bits of the sequential one; what
// the device does not do, the host does, with the same bits.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <quadrille/error.hpp>
#include <quadrille/names.hpp>
#include <quadrille/snapshot.hpp>
#include <quadrille/state_hash.hpp>

#include "cases.hpp"
#include "collision/random_scene.hpp"
#include "collision/support.hpp"
#include "core/world_access.hpp"
#include "device.hpp"
#include "lockstep.hpp"

namespace quadrille {
namespace {

const std::vector<CellsCase> partitioners = {
    {"grid", StaticGrid{}},           {"coarseGrid", StaticGrid{{300, 200}}},
    {"fineGrid", StaticGrid{{5, 3}}}, {"quadtree", Quadtree{}},
    {"skin", SemiStaticQuadtree{}},
};

SimulationConfig exact(const PartitionerConfig& cells = Quadtree{},
                       Precision precision = Precision::Double) {
    return {.partitioner = cells,
            .law = Law::Continuous,
            .precision = precision,
            .resolver = ResolverKind::CudaResident};
}

class ResidentExactScenes
    : public testing::TestWithParam<std::tuple<SceneCase, CellsCase, Precision>> {};

TEST_P(ResidentExactScenes, HaveTheBitsOfTheSequentialResolver) {
    QUADRILLE_NEEDS_DEVICE();
    const auto& [c, cells, precision] = GetParam();
    expectSceneInLockstep(c, exact(cells.config, precision));
}

std::string nameOf(const testing::TestParamInfo<ResidentExactScenes::ParamType>& test) {
    const auto& [c, cells, precision] = test.param;
    std::string text = c.scene + '_' + cells.name + '_' + std::string(name(precision));
    return testName(text);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ResidentExactScenes,
                         testing::Combine(testing::Values(SceneCase{"balanced", 3000, 60, 0.25},
                                                          SceneCase{"balanced-scaled", 4000, 100},
                                                          SceneCase{"imbalanced", 200, 30},
                                                          SceneCase{"imbalanced-clear", 300, 60},
                                                          SceneCase{"demo13k", 2000, 60, 0.1},
                                                          SceneCase{"mixed-sizes", 600, 30},
                                                          SceneCase{"pile", 300, 30},
                                                          SceneCase{"cradle", {}, 100}),
                                          testing::ValuesIn(partitioners),
                                          testing::Values(Precision::Double, Precision::Float)),
                         nameOf);

/// A gas of boxes, apart from each other.
World gas(int side, double spacing, double speed, bool own, bool pegs) {
    const double half = side * spacing / 2;
    World world({.size = {2 * half, 2 * half}});
    world.addWalls({.thickness = 20});
    Random random(20261128);
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const Vec2 at((i + 0.5) * spacing - half, (j + 0.5) * spacing - half);
            const Vec2 size = own ? Vec2(random.uniform(1, 4), random.uniform(1, 4)) : Vec2(3, 3);
            const Vec2 velocity(random.uniform(-speed, speed), random.uniform(-speed, speed));
            const bool peg = pegs && random.uniform(0, 1) < 0.05;
            const double mass = own ? random.uniform(0.5, 3) : 1;
            makeBox(world, at, peg ? fixed() : moving(velocity.x(), velocity.y(), mass), size);
        }
    }
    return world;
}

/// Nobody reads for hundreds of steps, and the device does them.
TEST(ResidentExact, HasTheBitsAfterStepsThatNobodyWatched) {
    QUADRILLE_NEEDS_DEVICE();
    struct Case {
        std::string name;
        World (*make)();
        double dt;
        double most;  ///< of the steps, that the host may do
        std::uint64_t steps = 300;
    };
    const std::vector<Case> cases = {
        {"gas", [] { return gas(60, 8, 25, false, false); }, 1.0 / 60, 0.01},
        {"fast", [] { return gas(60, 8, 300, false, false); }, 1.0 / 60, 0.05},
        {"dense", [] { return gas(60, 4, 25, false, false); }, 1.0 / 60, 0.05},
        {"own", [] { return gas(50, 9, 60, true, false); }, 1.0 / 60, 0.05},
        {"pegs", [] { return gas(50, 9, 60, true, true); }, 1.0 / 60, 0.05},
        {"short", [] { return gas(60, 8, 25, false, false); }, 1.0 / 960, 0.01},
        {"long", [] { return gas(60, 8, 25, false, false); }, 0.25, 0.05},
        {"imbalanced-clear", [] { return shippedScene("imbalanced-clear", 1700).world; }, 1.0 / 60,
         1, 60},
        {"demo13k", [] { return shippedScene("demo13k", 13000).world; }, 1.0 / 60, 0.05}};
    for (const Case& c : cases) {
        for (const Precision precision : {Precision::Double, Precision::Float}) {
            SimulationConfig config = exact(Quadtree{}, precision);
            config.step.dt = c.dt;
            SimulationConfig hosts = config;
            hosts.resolver = ResolverKind::Sequential;
            Simulation host(c.make(), hosts);
            host.run(c.steps);
            const std::uint64_t hash = stateHash(host.world());
            for (const int blockSize : {64, 128, 256}) {
                SCOPED_TRACE(c.name + ", blocks of " + std::to_string(blockSize) + ", " +
                             std::string(name(precision)));
                config.cuda.blockSize = blockSize;
                Simulation device(c.make(), config);
                std::uint64_t left = 0;
                for (std::uint64_t i = 0; i < c.steps; ++i) left += device.step().leftToHost;
                EXPECT_EQ(stateHash(device.world()), hash);
                EXPECT_LE(double(left), 2 + c.most * double(c.steps));
            }
        }
    }
}

class ResidentExactRandomScenes : public testing::TestWithParam<SceneKind> {};

TEST_P(ResidentExactRandomScenes, HaveTheBitsOfTheSequentialResolver) {
    QUADRILLE_NEEDS_DEVICE();
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const CellsCase& cells = partitioners[seed % partitioners.size()];
        SCOPED_TRACE("seed " + std::to_string(seed) + ", " + cells.name);
        SimulationConfig config =
            exact(cells.config, seed % 4 < 2 ? Precision::Double : Precision::Float);
        if (seed % 5 == 1) config.step.gravity = {0, -50};
        if (seed % 5 == 2) config.step.restitution = 0.6;
        // So few that they have some room: a crowd has millions of collisions a step.
        expectLockstep([&] { return randomScene(GetParam(), seed, 60); }, config, 30);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ResidentExactRandomScenes, testing::ValuesIn(sceneKinds),
                         testNameOfKind);

TEST(ResidentExact, HasTheBitsInWorldsOfFewBodies) {
    QUADRILLE_NEEDS_DEVICE();
    const auto world = [](int moving, int fixed) {
        World w({.size = {64, 64}});
        for (int i = 0; i < moving; ++i) makeBox(w, {i - 3.0, 0.25 * i}, quadrille::moving(10 - i));
        for (int i = 0; i < fixed; ++i) makeBox(w, {6.0 + i, 0}, quadrille::fixed());
        return w;
    };
    for (const auto& [moving, fixed] : {std::pair{0, 0}, {0, 3}, {1, 0}, {1, 1}, {5, 2}}) {
        SCOPED_TRACE(std::to_string(moving) + " moving, " + std::to_string(fixed) + " static");
        expectLockstep([&] { return world(moving, fixed); }, exact(), 60);
    }
}

TEST(ResidentExact, FollowsBodiesThatComeAndGoAndAreEdited) {
    QUADRILLE_NEEDS_DEVICE();
    const Edit edit = [](World& world, std::uint64_t step) {
        Random random(step);
        if (step % 7 == 3) {
            for (int i = 0; i < 20; ++i) {
                makeBox(world, {random.uniform(-130, 130), random.uniform(-130, 130)},
                        moving(random.uniform(-60, 60), random.uniform(-60, 60)), {2, 2});
            }
        }
        if (step % 11 == 4) makeBox(world, {double(step), 3}, fixed(), {4, 9});
        if (step % 9 == 2) {
            world.editBodies([&](const auto& bodies) {
                if (bodies.moving.size() > 4) bodies.moving.vx[4] += 30;
            });
        }
        if (step % 12 != 5) return;
        std::vector<Entity> bodies;
        world.each<PhysicsBody>([&](Entity e, const PhysicsBody&) { bodies.push_back(e); });
        for (std::size_t i = step % 4; i < bodies.size(); i += 9) world.destroy(bodies[i]);
    };
    expectLockstep([] { return gas(14, 18, 60, false, true); }, exact(), 80, edit);
}

/// What was going on elsewhere goes on here, and the other way round.
TEST(ResidentExact, GoesOnFromSnapshotsAndOnOtherResolvers) {
    QUADRILLE_NEEDS_DEVICE();
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        SimulationConfig config = exact(StaticGrid{}, precision);
        SimulationConfig hosts = config;
        hosts.resolver = ResolverKind::Sequential;
        const auto make = [] { return gas(40, 8, 40, true, true); };
        Simulation undisturbed(make(), hosts);
        undisturbed.run(120);

        Simulation first(make(), config);
        first.run(40);
        Simulation second(make(), hosts);
        second.restore(first.snapshot());
        second.run(40);
        Simulation third(make(), config);
        third.restore(second.snapshot());
        third.run(40);
        EXPECT_EQ(stateHash(third.world()), stateHash(undisturbed.world()));
    }
}

/// Rows of touching bodies, all of which collide at the same instants: far more in one window than
/// in others.
TEST(ResidentExact, MakesRoomAndLosesNothing) {
    QUADRILLE_NEEDS_DEVICE();
    const auto lattice = [] {
        World world({.size = {1000, 1000}});
        for (int i = 0; i < 120; ++i) {
            for (int j = 0; j < 120; ++j) {
                makeBox(world, {8.0 * i - 480, 8.0 * j - 480},
                        moving((i + j) % 2 == 0 ? 30 : -30, 0), {4, 4});
            }
        }
        return world;
    };
    const std::uint64_t contacts = expectLockstep(lattice, exact(), 30);
    EXPECT_GT(contacts, 20'000u);
}

/// Each is ten times as heavy as the next, so that the last one leaves several times as fast as any
/// body was when the partition was made.
TEST(ResidentExact, FollowsBodiesThatOutrunThePartition) {
    QUADRILLE_NEEDS_DEVICE();
    const auto rows = [] {
        World world = gas(30, 8, 3, false, false);
        for (int row = 0; row < 6; ++row) {
            for (int i = 0; i < 6; ++i) {
                makeBox(world, {200.0 + 5 * i, 40.0 * row - 100},
                        moving(i == 0 ? 9 : 0, 0, std::pow(10.0, 5 - i)), {3, 3});
            }
        }
        return world;
    };
    SimulationConfig config = exact();
    config.resolver = ResolverKind::Sequential;
    Simulation host(rows(), config);
    config.resolver = ResolverKind::CudaResident;
    Simulation device(rows(), config);
    std::uint64_t left = 0;
    for (int i = 0; i < 60; ++i) {
        host.step();
        left += device.step().leftToHost;
    }
    EXPECT_EQ(stateHash(device.world()), stateHash(host.world()));
    EXPECT_LT(left, 10u);
    double fastest = 0;
    host.world().each<PhysicsBody>(
        [&](Entity, const PhysicsBody& body) { fastest = std::max(fastest, body.velocity.x()); });
    EXPECT_GT(fastest, 100) << "else nothing outran what was allowed for";
}

}  // namespace
}  // namespace quadrille
