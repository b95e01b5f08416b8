// The resolver `cuda-resident` gives the bits of the sequential one, with bodies that stay on the
// device for as long as nobody looks at them.

#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <string>
#include <thread>
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

constexpr ResolverKind resident = ResolverKind::CudaResident;

const std::vector<CellsCase> partitioners = {
    {"grid", StaticGrid{}},           {"coarseGrid", StaticGrid{{300, 200}}},
    {"fineGrid", StaticGrid{{5, 3}}}, {"quadtree", Quadtree{}},
    {"skin", SemiStaticQuadtree{}},   {"bruteForce", BruteForce{}},
};

class ResidentScenes : public testing::TestWithParam<std::tuple<SceneCase, CellsCase, Precision>> {
};

TEST_P(ResidentScenes, HaveTheBitsOfTheSequentialResolver) {
    QUADRILLE_NEEDS_DEVICE();
    const auto& [c, cells, precision] = GetParam();
    expectSceneInLockstep(c, {.partitioner = cells.config,
                              .law = Law::Impulse,
                              .precision = precision,
                              .resolver = resident});
}

std::string nameOf(const testing::TestParamInfo<ResidentScenes::ParamType>& test) {
    const auto& [c, cells, precision] = test.param;
    std::string text = c.scene + '_' + cells.name + '_' + std::string(name(precision));
    return testName(text);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ResidentScenes,
                         testing::Combine(testing::ValuesIn(scenesOfDiscreteLaws),
                                          testing::ValuesIn(partitioners),
                                          testing::Values(Precision::Double, Precision::Float)),
                         nameOf);

/// Nobody reads for a thousand steps.
TEST(Resident, HasTheBitsAfterStepsThatNobodyWatched) {
    QUADRILLE_NEEDS_DEVICE();
    for (const std::string scene : {"imbalanced", "demo13k", "mixed-sizes", "pile"}) {
        for (const int blockSize : {64, 128, 256}) {
            SCOPED_TRACE(scene + ", blocks of " + std::to_string(blockSize));
            Scene loaded = shippedScene(scene, 500);
            SimulationConfig config{.partitioner = StaticGrid{}, .law = Law::Impulse};
            config.step = loaded.step;
            Simulation host(loaded.world.clone(), config);
            config.resolver = resident;
            config.cuda.blockSize = blockSize;
            Simulation device(std::move(loaded.world), config);
            host.run(1000);
            device.run(1000);
            EXPECT_EQ(stateHash(device.world()), stateHash(host.world()));
            EXPECT_EQ(device.config().resolver, resident);
        }
    }
}

class ResidentRandomScenes : public testing::TestWithParam<SceneKind> {};

TEST_P(ResidentRandomScenes, HaveTheBitsOfTheSequentialResolver) {
    QUADRILLE_NEEDS_DEVICE();
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        const CellsCase& cells = partitioners[seed % partitioners.size()];
        SCOPED_TRACE("seed " + std::to_string(seed) + ", " + cells.name);
        expectLockstep(
            [&] { return randomScene(GetParam(), seed); },
            {.partitioner = cells.config,
             .law = Law::Impulse,
             .precision = seed % 4 < 2 ? Precision::Double : Precision::Float,
             .resolver = resident,
             .step = {.gravity = {seed % 5 == 1 ? 20.0 : 0.0, seed % 2 == 0 ? 0.0 : -50.0},
                      .restitution = seed % 3 == 0 ? 1 : 0.6},
             .cuda = {.threadPer = seed % 7 == 6 ? CudaThread::Cell : CudaThread::Body}},
            40);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ResidentRandomScenes, testing::ValuesIn(sceneKinds),
                         testNameOfKind);

World someBoxes(int count, bool own = false) {
    World world({.size = {300, 300}});
    world.addWalls({.thickness = 20});
    Random random(3);
    for (int i = 0; i < count; ++i) {
        const Vec2 size = own ? Vec2(random.uniform(1, 9), random.uniform(1, 9)) : Vec2(4, 4);
        makeBox(world, {random.uniform(-130, 130), random.uniform(-130, 130)},
                moving(random.uniform(-60, 60), random.uniform(-60, 60)), size);
    }
    return world;
}

/// More entries and more contacts than the first guess has room for, and one body that meets
/// thousands and covers all cells.
TEST(Resident, MakesRoomAndLosesNothing) {
    QUADRILLE_NEEDS_DEVICE();
    const auto crowd = [] {
        World world({.size = {400, 400}, .seed = 7});
        Random random(20261122);
        for (int i = 0; i < 12'000; ++i) {
            makeBox(
                world, {random.uniform(-190, 190), random.uniform(-190, 190)},
                moving(random.uniform(-40, 40), random.uniform(-40, 40), i % 7 == 0 ? 3.0 : 1.0),
                {3, 3});
        }
        makeBox(world, {0, 0}, moving(3, 2, 50), {250, 250});
        world.addWalls({.thickness = 40});
        return world;
    };
    for (const PartitionerConfig& cells :
         {PartitionerConfig(StaticGrid{{1, 1}}), PartitionerConfig(Quadtree{})}) {
        const std::uint64_t contacts = expectLockstep(crowd,
                                                      {.partitioner = cells,
                                                       .law = Law::Impulse,
                                                       .resolver = resident,
                                                       .step = {.restitution = 0.9}},
                                                      4);
        EXPECT_GT(contacts, 50'000u);
    }
}

/// Rooms full of boxes with pegs among them, and a push that the light box cannot give way to.
TEST(Resident, KeepsBodiesOutOfStaticBoxes) {
    QUADRILLE_NEEDS_DEVICE();
    const auto room = [] {
        World world({.size = {200, 160}});
        world.addWalls({.thickness = 40});
        makeBox(world, {20, 0}, fixed(), {10, 10});
        makeBox(world, {12.5, 0}, moving(0, 0, 1), {4, 4});
        makeBox(world, {8.2, 0}, moving(300, 0, 1000), {4, 4});
        // One that starts in two static boxes.
        makeBox(world, {60, 50}, fixed(), {10, 20});
        makeBox(world, {73, 50}, fixed(), {10, 20});
        makeBox(world, {66.6, 50}, moving(7, 3), {4, 4});
        Random random(20261128);
        for (int i = -9; i < 9; ++i) {
            for (int j = -7; j < 7; ++j) {
                const Vec2 size(random.uniform(4, 7), random.uniform(4, 7));
                const Vec2 velocity(random.uniform(-90, 90), random.uniform(-90, 90));
                const bool peg = random.uniform(0, 1) < 0.1;
                makeBox(world, {10.0 * i + 5, 10.0 * j + 5},
                        peg ? fixed() : moving(velocity.x(), velocity.y(), 1 + i * i), size);
            }
        }
        return world;
    };
    const Edit removesAPeg = [](World& world, std::uint64_t step) {
        if (step % 20 != 19) return;
        Entity peg;
        world.each<PhysicsBody>([&](Entity e, const PhysicsBody& b) {
            if (b.isStatic) peg = e;
        });
        world.destroy(peg);
    };
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        for (const CellsCase& cells : partitioners) {
            SCOPED_TRACE(cells.name);
            expectLockstep(room,
                           {.partitioner = cells.config,
                            .law = Law::Impulse,
                            .precision = precision,
                            .resolver = resident,
                            .step = {.gravity = {0, -300}, .restitution = 0.4}},
                           100, removesAPeg);
        }
    }
}

TEST(Resident, HasTheBitsInWorldsOfFewBodies) {
    QUADRILLE_NEEDS_DEVICE();
    const auto world = [](int moving, int fixed) {
        World w({.size = {64, 64}});
        for (int i = 0; i < moving; ++i) makeBox(w, {i - 3.0, 0.25 * i}, quadrille::moving(10 - i));
        for (int i = 0; i < fixed; ++i) makeBox(w, {6.0 + i, 0}, quadrille::fixed());
        return w;
    };
    for (const CellsCase& cells : partitioners) {
        for (const auto& [moving, fixed] : {std::pair{0, 0}, {0, 3}, {1, 0}, {1, 1}, {5, 2}}) {
            SCOPED_TRACE(cells.name + ", " + std::to_string(moving) + " moving, " +
                         std::to_string(fixed) + " static");
            expectLockstep([&] { return world(moving, fixed); },
                           {.partitioner = cells.config, .law = Law::Impulse, .resolver = resident},
                           60);
        }
    }
}

TEST(Resident, FollowsBodiesThatComeAndGoAndAreEdited) {
    QUADRILLE_NEEDS_DEVICE();
    const Edit edit = [](World& world, std::uint64_t step) {
        Random random(step);
        if (step % 7 == 3) {
            for (std::uint64_t i = 0; i < 20 * step; ++i) {
                makeBox(world, {random.uniform(-130, 130), random.uniform(-130, 130)},
                        moving(random.uniform(-60, 60), random.uniform(-60, 60)));
            }
        }
        if (step % 5 == 4) makeBox(world, {double(step), 3}, fixed(), {4, 9});
        if (step == 12) makeBox(world, {1, 2}, moving(5, 5, 3), {2, 2});
        if (step % 6 != 5) return;
        std::vector<Entity> bodies;
        world.each<PhysicsBody>([&](Entity e, const PhysicsBody&) { bodies.push_back(e); });
        for (std::size_t i = step % 4; i < bodies.size(); i += 9) world.destroy(bodies[i]);
    };
    for (const PartitionerConfig& cells :
         {PartitionerConfig(StaticGrid{}), PartitionerConfig(Quadtree{})}) {
        expectLockstep([] { return someBoxes(50); },
                       {.partitioner = cells, .law = Law::Impulse, .resolver = resident}, 60, edit);
    }
}

/// Rows in another order than that of creation, changed on the way.
TEST(Resident, HasTheBitsOfRowsInOrderOfCreation) {
    QUADRILLE_NEEDS_DEVICE();
    const auto shuffled = [](std::size_t count, Random& random) {
        std::vector<std::uint32_t> order(count);
        std::iota(order.begin(), order.end(), 0u);
        for (std::size_t i = count; i > 1; --i) {
            const auto other = random.integer(0, static_cast<std::int64_t>(i) - 1);
            std::swap(order[i - 1], order[static_cast<std::size_t>(other)]);
        }
        return order;
    };
    for (const Precision precision : {Precision::Double, Precision::Float}) {
        SimulationConfig config{.partitioner = StaticGrid{},
                                .law = Law::Impulse,
                                .precision = precision,
                                .step = {.gravity = {0, -30}, .restitution = 0.8},
                                .keepContacts = true};
        Simulation host(someBoxes(900, true), config);
        config.resolver = resident;
        Simulation device(someBoxes(900, true), config);
        for (std::uint64_t step = 0; step < 30; ++step) {
            SCOPED_TRACE("step " + std::to_string(step));
            if (step % 6 == 0) {
                World& world = device.world();
                world.flush();
                Random random(step);
                const auto order = shuffled(world.movingCount(), random);
                WorldAccess::permute(world, order, shuffled(world.staticCount(), random));
            }
            host.step();
            device.step();
            expectSameContacts(device.contacts(), host.contacts());
            EXPECT_EQ(stateHash(device.world()), stateHash(host.world()));
            if (testing::Test::HasFailure()) return;
        }
    }
}

TEST(Resident, ShowsTheCellsOfTheGrid) {
    QUADRILLE_NEEDS_DEVICE();
    SimulationConfig config{.partitioner = StaticGrid{{20, 30}}, .law = Law::Impulse};
    Simulation host(someBoxes(500, true), config);
    config.resolver = resident;
    Simulation device(someBoxes(500, true), config);
    for (int i = 0; i < 3; ++i) {
        host.run(5);
        device.run(5);
        const Cells& found = device.cells();
        const Cells& expected = host.cells();
        EXPECT_EQ(found.offsets, expected.offsets);
        EXPECT_EQ(found.bodies, expected.bodies);
        EXPECT_EQ(found.origin, expected.origin);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t c = 0; c < found.size(); ++c) {
            EXPECT_EQ(found.bounds(c).low, expected.bounds(c).low);
            EXPECT_EQ(found.bounds(c).high, expected.bounds(c).high);
        }
    }
}

TEST(Resident, GoesOnFromSnapshotsAndOnOtherResolvers) {
    QUADRILLE_NEEDS_DEVICE();
    Simulation host(someBoxes(700), {.law = Law::Impulse});
    Simulation device(someBoxes(700), {.law = Law::Impulse, .resolver = resident});
    host.run(20);
    device.run(20);
    const Snapshot then = device.snapshot();
    host.run(20);
    device.run(20);
    const std::uint64_t hash = stateHash(host.world());
    EXPECT_EQ(stateHash(device.world()), hash);
    device.restore(then);
    device.run(20);
    EXPECT_EQ(stateHash(device.world()), hash);
    device.restore(then);
    device.run(7);
    for (const ResolverKind next : {ResolverKind::Sequential, resident, ResolverKind::Cuda}) {
        SimulationConfig config = device.config();
        config.resolver = next;
        device.reconfigure(config);
        if (next == ResolverKind::Cuda) break;
        device.run(6);
    }
    device.run(1);
    EXPECT_EQ(stateHash(device.world()), hash);
    EXPECT_EQ(device.resolverFailure(), "");
}

TEST(Resident, NamesABodyThatIsNoLongerFinite) {
    QUADRILLE_NEEDS_DEVICE();
    const auto messageOf = [](ResolverKind resolver) {
        World world = someBoxes(300);
        Simulation sim(std::move(world), {.law = Law::Impulse, .resolver = resolver});
        sim.run(2);
        sim.world().editBodies([](const auto& bodies) {
            bodies.moving.vx[41] = std::numeric_limits<double>::infinity();
            bodies.moving.x[97] = std::numeric_limits<double>::quiet_NaN();
        });
        try {
            sim.run(2);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    EXPECT_EQ(messageOf(resident), messageOf(ResolverKind::Sequential));
}

TEST(Resident, RunsSeveralSimulationsAtOnce) {
    QUADRILLE_NEEDS_DEVICE();
    constexpr int runs = 4;
    std::vector<std::uint64_t> hashes(runs);
    std::vector<std::thread> threads;
    for (int i = 0; i < runs; ++i) {
        threads.emplace_back([&hashes, i] {
            Simulation sim(someBoxes(400 + 100 * (i / 2)),
                           {.law = Law::Impulse, .resolver = resident});
            sim.run(100);
            hashes[i] = stateHash(sim.world());
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (int i = 0; i < runs; ++i) {
        Simulation host(someBoxes(400 + 100 * (i / 2)), {.law = Law::Impulse});
        host.run(100);
        EXPECT_EQ(hashes[i], stateHash(host.world())) << i;
    }
}

TEST(Resident, GoesOnSequentiallyWhenMemoryRunsOut) {
    QUADRILLE_NEEDS_DEVICE();
    const auto addMany = [](World& world) {
        Random random(11);
        for (int i = 0; i < 60'000; ++i) {
            makeBox(world, {random.uniform(-140, 140), random.uniform(-140, 140)},
                    moving(random.uniform(-9, 9), 0), {0.5, 0.5});
        }
    };
    Simulation device(someBoxes(500), {.law = Law::Impulse,
                                       .resolver = resident,
                                       .cuda = {.memoryLimit = 4 << 20},
                                       .fallback = true});
    Simulation host(someBoxes(500), {.law = Law::Impulse});
    device.run(20);
    host.run(20);
    EXPECT_EQ(device.resolverFailure(), "");
    EXPECT_EQ(device.config().resolver, resident);
    addMany(device.world());
    addMany(host.world());
    device.run(3);
    host.run(3);
    EXPECT_EQ(device.config().resolver, ResolverKind::Sequential);
    EXPECT_NE(device.resolverFailure().find("out of device memory"), std::string::npos)
        << device.resolverFailure();
    EXPECT_EQ(stateHash(device.world()), stateHash(host.world()));
}

TEST(Resident, KeepsCountOfThePhases) {
    QUADRILLE_NEEDS_DEVICE();
    Simulation sim(someBoxes(2000), {.law = Law::Impulse, .resolver = resident, .profile = true});
    sim.run(3);
    const StepReport& report = sim.step();
    for (const Phase phase : {Phase::Integrate, Phase::Partition, Phase::Resolve}) {
        EXPECT_GT(report.phaseSeconds[static_cast<std::size_t>(phase)], 0) << name(phase);
    }
    for (const Phase phase : {Phase::Flatten, Phase::CopyToDevice, Phase::CopyToHost}) {
        EXPECT_EQ(report.phaseSeconds[static_cast<std::size_t>(phase)], 0) << name(phase);
    }
}

}  // namespace
}  // namespace quadrille
