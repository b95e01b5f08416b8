// A step allocates nothing once the buffers have grown. This program replaces operator new to see.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>
#include <new>
#include <string>

#include <quadrille/names.hpp>

#include "collision/support.hpp"
#include "sanitized.hpp"

namespace {

std::atomic<std::uint64_t> allocations{0};

void* allocate(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}

void* allocate(std::size_t size, std::align_val_t alignment) {
    ++allocations;
    const auto align = static_cast<std::size_t>(alignment);
#ifdef _WIN32
    void* memory = _aligned_malloc(size, align);
#else
    void* memory = std::aligned_alloc(align, (size + align - 1) / align * align);
#endif
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void release(void* memory) noexcept { std::free(memory); }

void releaseAligned(void* memory) noexcept {
#ifdef _WIN32
    _aligned_free(memory);
#else
    std::free(memory);
#endif
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void* operator new(std::size_t size, std::align_val_t align) { return allocate(size, align); }
void* operator new[](std::size_t size, std::align_val_t align) { return allocate(size, align); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { releaseAligned(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { releaseAligned(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    releaseAligned(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
    releaseAligned(memory);
}

namespace quadrille {
namespace {

/// Until then bodies that start on a lattice meet more and more often, and buffers grow with them.
constexpr std::uint64_t warmUp = 3000;

/// Allocations in 200 steps of `balanced` with 2,000 bodies, after those to warm up.
std::uint64_t allocationsOf(const PartitionerConfig& partitioner, Precision precision,
                            bool listen = false) {
    Simulation sim = simulationOf(shippedScene("balanced", 2000), partitioner, precision);
    std::uint64_t seen = 0;
    if (listen) sim.onContact([&](const Contact&) { ++seen; });
    sim.run(warmUp);
    const std::uint64_t before = allocations;
    sim.run(200);
    const std::uint64_t after = allocations;
    EXPECT_TRUE(!listen || seen > 0);
    return after - before;
}

class Allocation : public testing::TestWithParam<Precision> {};

INSTANTIATE_TEST_SUITE_P(Precisions, Allocation,
                         testing::Values(Precision::Double, Precision::Float),
                         [](const auto& test) { return std::string(name(test.param)); });

TEST(AllocationCounter, Counts) {
    const std::uint64_t before = allocations;
    delete new int(1);
    std::string(1000, 'x');
    EXPECT_EQ(allocations - before, 2u);
}

TEST_P(Allocation, NoneWithAStaticGrid) { EXPECT_EQ(allocationsOf(StaticGrid{}, GetParam()), 0u); }

TEST_P(Allocation, NoneWithAQuadtree) { EXPECT_EQ(allocationsOf(Quadtree{}, GetParam()), 0u); }

TEST_P(Allocation, NoneWithASemiStaticQuadtree) {
    EXPECT_EQ(allocationsOf(SemiStaticQuadtree{}, GetParam()), 0u);
}

TEST_P(Allocation, NoneWithASkinOfFixedWidth) {
    EXPECT_EQ(allocationsOf(SemiStaticQuadtree{10, 20, SemiStaticQuadtree::Skin{1}}, GetParam()),
              0u);
}

TEST_P(Allocation, NoneWithAListener) {
    EXPECT_EQ(allocationsOf(Quadtree{}, GetParam(), true), 0u);
}

TEST_P(Allocation, NoneWithThreads) {
    if (sanitized) GTEST_SKIP() << "takes long, and counts what any build does";
    // Enough bodies for loops to be shared out, and crowded, so that contacts are as well.
    Scene scene = shippedScene("demo13k", 9000);
    Simulation sim(std::move(scene.world), {.partitioner = Quadtree{},
                                            .law = Law::Impulse,
                                            .precision = GetParam(),
                                            .resolver = ResolverKind::Threads,
                                            .threads = 3,
                                            .step = {.dt = scene.step.dt}});
    // Every worker has buffers of its own, which takes them longer to see their largest.
    sim.run(1500);
    const std::uint64_t before = allocations;
    sim.run(300);
    EXPECT_EQ(allocations - before, 0u);
}

TEST_P(Allocation, NoneWithTheLawBaseline) {
    Scene scene = shippedScene("balanced", 2000);
    Simulation sim(std::move(scene.world), {.partitioner = Quadtree{},
                                            .law = Law::Baseline,
                                            .precision = GetParam(),
                                            .step = {.dt = scene.step.dt}});
    sim.run(warmUp);
    const std::uint64_t before = allocations;
    sim.run(200);
    EXPECT_EQ(allocations - before, 0u);
}

}  // namespace
}  // namespace quadrille
