// The resolver `cuda` as it lives: bodies that come and go, several at once, memory that runs out.

#include <gtest/gtest.h>
#include <string>
#include <thread>
#include <vector>

#include <quadrille/error.hpp>
#include <quadrille/state_hash.hpp>

#include "collision/support.hpp"
#include "device.hpp"
#include "lockstep.hpp"

namespace quadrille {
namespace {

World someBoxes(int count) {
    World world({.size = {300, 300}});
    world.addWalls({.thickness = 20});
    Random random(3);
    for (int i = 0; i < count; ++i) {
        makeBox(world, {random.uniform(-130, 130), random.uniform(-130, 130)},
                moving(random.uniform(-60, 60), random.uniform(-60, 60)));
    }
    return world;
}

TEST(CudaResolver, FollowsBodiesThatComeAndGoAndAreEdited) {
    QUADRILLE_NEEDS_DEVICE();
    const Edit edit = [](World& world, std::uint64_t step) {
        Random random(step);
        if (step % 7 == 3) {  // the buffers grow
            for (std::uint64_t i = 0; i < 20 * step; ++i) {
                makeBox(world, {random.uniform(-130, 130), random.uniform(-130, 130)},
                        moving(random.uniform(-60, 60), random.uniform(-60, 60)));
            }
        }
        if (step % 5 == 4) makeBox(world, {double(step), 3}, fixed(), {4, 9});
        if (step == 12) {  // masses and sizes that were one number become columns
            makeBox(world, {1, 2}, moving(5, 5, 3), {2, 2});
            makeBox(world, {4, 2}, moving(-5, 5), {5, 1});
        }
        if (step % 6 != 5) return;
        std::vector<Entity> bodies;
        world.each<PhysicsBody>([&](Entity e, const PhysicsBody&) { bodies.push_back(e); });
        for (std::size_t i = step % 4; i < bodies.size(); i += 9) world.destroy(bodies[i]);
        for (std::size_t i = 1; i < bodies.size(); i += 9) {
            if (i % 9 == step % 4) continue;
            PhysicsBody body = world.get<PhysicsBody>(bodies[i]);
            if (body.isStatic) continue;
            body.velocity *= -0.5;
            world.set(bodies[i], body);
        }
    };
    for (const Law law : {Law::Impulse, Law::Baseline}) {
        for (const PartitionerConfig& cells :
             {PartitionerConfig(Quadtree{}), PartitionerConfig(SemiStaticQuadtree{})}) {
            expectLockstep([] { return someBoxes(50); }, {.partitioner = cells, .law = law}, 60,
                           edit);
        }
    }
}

TEST(CudaResolver, FollowsAChangeOfPartitioner) {
    QUADRILLE_NEEDS_DEVICE();
    Simulation device(someBoxes(800), {.law = Law::Impulse, .resolver = ResolverKind::Cuda});
    Simulation host(someBoxes(800), {.law = Law::Impulse});
    for (const PartitionerConfig& cells :
         {PartitionerConfig(StaticGrid{}), PartitionerConfig(SemiStaticQuadtree{}),
          PartitionerConfig(BruteForce{}), PartitionerConfig(Quadtree{})}) {
        device.setPartitioner(cells);
        device.run(15);
        host.run(15);
        EXPECT_EQ(stateHash(device.world()), stateHash(host.world()));
    }
}

TEST(CudaResolver, KeepsContactsOnlyWhileSomebodyListens) {
    QUADRILLE_NEEDS_DEVICE();
    for (const Law law : {Law::Impulse, Law::Baseline}) {
        Simulation host(someBoxes(600), {.law = law, .keepContacts = true});
        Simulation device(someBoxes(600), {.law = law, .resolver = ResolverKind::Cuda});
        std::vector<Contact> heard;
        for (std::uint64_t step = 0; step < 24; ++step) {
            SCOPED_TRACE("step " + std::to_string(step));
            heard.clear();
            Subscription listener;
            const bool listens = step / 3 % 2 == 1;
            if (listens) {
                listener = device.onContact([&](const Contact& c) { heard.push_back(c); });
            }
            host.step();
            device.step();
            listener.remove();
            if (listens) expectSameContacts(heard, host.contacts());
            EXPECT_EQ(stateHash(device.world()), stateHash(host.world()));
        }
    }
}

TEST(CudaResolver, RunsSeveralSimulationsAtOnce) {
    QUADRILLE_NEEDS_DEVICE();
    constexpr int runs = 4;
    std::vector<std::uint64_t> hashes(runs);
    std::vector<std::thread> threads;
    for (int i = 0; i < runs; ++i) {
        threads.emplace_back([&hashes, i] {
            Simulation sim(someBoxes(400 + 100 * (i / 2)),
                           {.law = Law::Impulse, .resolver = ResolverKind::Cuda});
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

TEST(CudaResolver, KeepsCountOfThePhases) {
    QUADRILLE_NEEDS_DEVICE();
    Simulation sim(someBoxes(2000), {.partitioner = Quadtree{},
                                     .law = Law::Impulse,
                                     .resolver = ResolverKind::Cuda,
                                     .profile = true});
    sim.run(3);
    const StepReport& report = sim.step();
    for (const Phase phase : {Phase::Integrate, Phase::Partition, Phase::Flatten,
                              Phase::CopyToDevice, Phase::Resolve, Phase::CopyToHost}) {
        EXPECT_GT(report.phaseSeconds[static_cast<std::size_t>(phase)], 0)
            << static_cast<int>(phase);
    }
}

SimulationConfig limited(bool fallback) {
    return {.law = Law::Impulse,
            .resolver = ResolverKind::Cuda,
            .cuda = {.memoryLimit = 4 << 20},
            .fallback = fallback};
}

/// More bodies than 4 MiB hold, added on the way.
void addMany(World& world) {
    Random random(11);
    for (int i = 0; i < 60'000; ++i) {
        makeBox(world, {random.uniform(-140, 140), random.uniform(-140, 140)},
                moving(random.uniform(-9, 9), 0), {0.5, 0.5});
    }
}

TEST(CudaResolver, GoesOnSequentiallyWhenMemoryRunsOut) {
    QUADRILLE_NEEDS_DEVICE();
    Simulation device(someBoxes(500), limited(true));
    Simulation host(someBoxes(500), {.partitioner = Quadtree{}, .law = Law::Impulse});
    device.run(20);
    host.run(20);
    EXPECT_EQ(device.resolverFailure(), "");
    EXPECT_EQ(device.config().resolver, ResolverKind::Cuda);
    addMany(device.world());
    addMany(host.world());
    device.run(3);
    host.run(3);
    EXPECT_EQ(device.config().resolver, ResolverKind::Sequential);
    EXPECT_NE(device.resolverFailure().find("out of device memory"), std::string::npos)
        << device.resolverFailure();
    EXPECT_NE(device.resolverFailure().find(" free"), std::string::npos);
    EXPECT_EQ(stateHash(device.world()), stateHash(host.world()));
}

TEST(CudaResolver, SaysHowMuchMemoryItLacks) {
    QUADRILLE_NEEDS_DEVICE();
    Simulation device(someBoxes(500), limited(false));
    device.run(5);
    addMany(device.world());
    try {
        device.step();
        FAIL() << "no error";
    } catch (const DeviceError& error) {
        EXPECT_NE(std::string(error.what()).find("bytes"), std::string::npos) << error.what();
    }
}

TEST(CudaResolver, IsADeviceErrorWithoutADevice) {
    if (findCudaDevice().usable()) GTEST_SKIP() << "there is a device";
    EXPECT_THROW(Simulation(someBoxes(5), {.law = Law::Impulse, .resolver = ResolverKind::Cuda}),
                 DeviceError);
    Simulation sim(someBoxes(5),
                   {.law = Law::Impulse, .resolver = ResolverKind::Cuda, .fallback = true});
    EXPECT_EQ(sim.config().resolver, ResolverKind::Sequential);
    EXPECT_EQ(sim.resolverFailure(), "cuda: " + findCudaDevice().reason);
    sim.run(3);
}

}  // namespace
}  // namespace quadrille
