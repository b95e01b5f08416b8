// A device that is missing; that it fails on the way is tested in tests/gpu.

#include <gtest/gtest.h>

#include <quadrille/device.hpp>
#include <quadrille/error.hpp>
#include <quadrille/measure.hpp>
#include <quadrille/scene.hpp>
#include <quadrille/simulation.hpp>

namespace quadrille {
namespace {

World twoBoxes() {
    World world({.size = {100, 100}});
    for (const double side : {-1.0, 1.0}) {
        world.add(world.create(), Transform{{4 * side, 0}}, BoxCollider{{2, 2}},
                  PhysicsBody{.velocity = {-30 * side, 0}});
    }
    return world;
}

TEST(MissingDevice, IsAnErrorThatSaysWhy) {
    const CudaDevice device = findCudaDevice();
    if (device.usable()) GTEST_SKIP() << "there is a device";
    EXPECT_FALSE(device.reason.empty());
    try {
        Simulation(twoBoxes(), {.resolver = ResolverKind::Cuda});
        FAIL() << "no error";
    } catch (const DeviceError& error) {
        EXPECT_EQ(std::string(error.what()), "cuda: " + device.reason);
    }
}

TEST(MissingDevice, IsReplacedWhereThatIsAllowed) {
    if (findCudaDevice().usable()) GTEST_SKIP() << "there is a device";
    Simulation sim(twoBoxes(), {.resolver = ResolverKind::Cuda, .fallback = true});
    EXPECT_EQ(sim.config().resolver, ResolverKind::Sequential);
    EXPECT_FALSE(sim.resolverFailure().empty());
    sim.setPartitioner(Quadtree{});
    EXPECT_EQ(sim.config().resolver, ResolverKind::Sequential);
    EXPECT_FALSE(sim.resolverFailure().empty());
    Simulation sequential(twoBoxes());
    EXPECT_EQ(sequential.resolverFailure(), "");
    sim.run(20);
    sequential.run(20);
    EXPECT_EQ(stateHash(sim.world()), stateHash(sequential.world()));
}

TEST(MissingDevice, LeavesThePartitionToTheThreads) {
    if (findCudaDevice().usable()) GTEST_SKIP() << "there is a device";
    const auto crowd = [] {
        return loadScene(QUADRILLE_SCENES_DIR "/balanced.toml", {.entities = 20'000}).world;
    };
    for (const PartitionerConfig& partitioner :
         {PartitionerConfig(Quadtree{}), PartitionerConfig(SemiStaticQuadtree{})}) {
        Simulation sim(crowd(), {.partitioner = partitioner,
                                 .resolver = ResolverKind::Cuda,
                                 .threads = 3,
                                 .fallback = true});
        EXPECT_EQ(sim.threads(), 3);
        Simulation sequential(crowd(), {.partitioner = partitioner});
        EXPECT_EQ(sequential.threads(), 1);
        sim.run(5);
        sequential.run(5);
        EXPECT_EQ(stateHash(sim.world()), stateHash(sequential.world()));
    }
}

TEST(CudaOptions, BlockSizesThatCannotBeAreRefused) {
    for (const int size : {0, -32, 16, 33, 1056}) {
        EXPECT_THROW(Simulation(twoBoxes(), {.cuda = {.blockSize = size}}), Error) << size;
    }
}

}  // namespace
}  // namespace quadrille
