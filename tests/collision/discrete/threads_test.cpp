// The resolver `threads` gives what `sequential` gives, bit for bit: state, contacts, cells,
// counts.

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <quadrille/names.hpp>
#include <quadrille/state_hash.hpp>

#include "collision/random_scene.hpp"
#include "collision/support.hpp"
#include "collision/thread_checks.hpp"
#include "sanitized.hpp"

namespace quadrille {
namespace {

using EveryFrames = SemiStaticQuadtree::EveryFrames;
const std::vector<PartitionerConfig> partitioners = [] {
    auto all = completePartitioners;
    // Misses pairs, and shows some more than once.
    all.push_back(SemiStaticQuadtree{10, 4, EveryFrames{7}});
    return all;
}();

class Threads : public testing::TestWithParam<Precision> {};

INSTANTIATE_TEST_SUITE_P(Precisions, Threads, testing::Values(Precision::Double, Precision::Float),
                         [](const auto& test) { return std::string(name(test.param)); });

TEST_P(Threads, RandomScenes) {
    for (const SceneKind kind : sceneKinds) {
        for (std::uint64_t seed = 100; seed < 102; ++seed) {
            for (std::size_t i = 0; i < partitioners.size(); ++i) {
                if (sanitized && (i + seed) % 3 != std::size_t(kind) % 3) continue;
                SCOPED_TRACE(std::string(name(kind)) + ", seed " + std::to_string(seed) +
                             ", partitioner " + std::to_string(i));
                expectTheSameOnThreads([&] { return randomScene(kind, seed, 120, 200); },
                                       {.partitioner = partitioners[i],
                                        .law = Law::Impulse,
                                        .precision = GetParam(),
                                        .step = {.gravity = {0, seed % 2 == 0 ? 0.0 : -50.0},
                                                 .restitution = seed % 3 == 0 ? 1 : 0.6}},
                                       6, {threadCounts[(seed + i) % threadCounts.size()]});
                if (HasFailure()) return;
            }
        }
    }
}

TEST_P(Threads, TreesThatAreSplitOnAllThreads) {
    // Enough references for several blocks in the upper nodes, and nodes that all bodies cover.
    for (std::uint64_t seed = 8; seed < 10; ++seed) {
        const auto world = [&] {
            World w({.size = {400, 300}, .seed = seed});
            Random& random = w.random();
            for (int i = 0; i < 6000; ++i) {
                const bool crowded = i % (sanitized ? 12 : 3) == 0;
                const Vec2 position =
                    crowded ? Vec2(random.uniform(60, 63), random.uniform(50, 70))
                            : Vec2(random.uniform(-200, 200), random.uniform(-150, 150));
                makeBox(w, position, moving(random.uniform(-30, 30), random.uniform(-30, 30)),
                        seed == 9 && i % 2 == 0 ? Vec2(3, 3) : Vec2(1, 2));
            }
            return w;
        };
        for (const PartitionerConfig& partitioner : std::vector<PartitionerConfig>{
                 Quadtree{10, 20}, Quadtree{3, 50}, StaticGrid{}, SemiStaticQuadtree{}}) {
            SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::string(name(partitioner)));
            expectTheSameOnThreads(
                world, {.partitioner = partitioner, .law = Law::Impulse, .precision = GetParam()},
                2, {3});
            if (HasFailure()) return;
        }
    }
}

struct Shipped {
    std::string scene;
    std::uint64_t entities;  ///< 0: as many as the scene has
};

std::ostream& operator<<(std::ostream& out, const Shipped& s) {
    return out << s.scene << ", " << s.entities << " entities";
}

class ShippedScenes : public testing::TestWithParam<std::tuple<Shipped, Precision>> {};

TEST_P(ShippedScenes, EveryPartitionerAndNumberOfThreads) {
    const auto& [shipped, precision] = GetParam();
    const auto load = [&, count = shipped.entities, file = shipped.scene] {
        return count > 0 ? shippedScene(file, count) : shippedScene(file);
    };
    const StepSettings step = load().step;
    for (std::size_t i = 0; i < partitioners.size(); ++i) {
        SCOPED_TRACE("partitioner " + std::to_string(i));
        expectTheSameOnThreads([&] { return load().world; },
                               {.partitioner = partitioners[i],
                                .law = Law::Impulse,
                                .precision = precision,
                                .step = step},
                               12, threadCountsOf(i + 1));
        if (HasFailure()) return;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Threads, ShippedScenes,
    testing::Combine(testing::Values(Shipped{"balanced", 300}, Shipped{"balanced-scaled", 300},
                                     Shipped{"bullet", 0}, Shipped{"cradle", 0},
                                     Shipped{"demo13k", 300}, Shipped{"imbalanced", 20},
                                     Shipped{"mixed-sizes", 300}, Shipped{"pi", 0},
                                     Shipped{"pile", 200}),
                     testing::Values(Precision::Double, Precision::Float)),
    [](const auto& test) {
        std::string text =
            std::get<0>(test.param).scene + "In" + std::string(name(std::get<1>(test.param)));
        std::erase(text, '-');
        return text;
    });

// ---- through the public interface, where short loops stay on one thread

std::uint64_t hashAfter(const std::string& scene, std::uint64_t entities, int threads,
                        std::uint64_t steps) {
    Scene loaded = shippedScene(scene, entities);
    Simulation sim(std::move(loaded.world),
                   {.law = Law::Impulse,
                    .resolver = threads > 0 ? ResolverKind::Threads : ResolverKind::Sequential,
                    .threads = threads,
                    .step = loaded.step});
    EXPECT_EQ(sim.threads(), std::max(threads, 1));
    sim.run(steps);
    return stateHash(sim.world());
}

TEST(ThreadsInSimulation, LargeScenesEndInTheSameState) {
    for (const auto& [scene, entities, steps] :
         {std::tuple("demo13k", 12'000, 60), std::tuple("balanced", 30'000, 40),
          std::tuple("imbalanced", 500, 60), std::tuple("pile", 4'000, 60)}) {
        SCOPED_TRACE(scene);
        const std::uint64_t expected = hashAfter(scene, entities, 0, steps);
        EXPECT_EQ(hashAfter(scene, entities, 2, steps), expected);
        EXPECT_EQ(hashAfter(scene, entities, 5, steps), expected);
    }
}

TEST(ThreadsInSimulation, ListenersHearTheContactsInCanonicalOrder) {
    const auto contacts = [](ResolverKind resolver) {
        Scene scene = shippedScene("imbalanced", 200);
        Simulation sim(std::move(scene.world), {.law = Law::Impulse,
                                                .resolver = resolver,
                                                .threads = 3,
                                                .step = {.dt = scene.step.dt}});
        std::vector<std::tuple<double, std::int64_t, std::int64_t, bool>> seen;
        sim.onContact(
            [&](const Contact& c) { seen.emplace_back(c.time, c.numberA, c.numberB, c.collided); });
        sim.run(20);
        return seen;
    };
    const auto expected = contacts(ResolverKind::Sequential);
    EXPECT_GT(expected.size(), 10'000u);
    EXPECT_TRUE(contacts(ResolverKind::Threads) == expected);
}

TEST(ThreadsInSimulation, OneLongChainOfContacts) {
    // Every body touches the next, so that each contact waits for another one.
    const auto hash = [](ResolverKind resolver) {
        World world({.size = {20'000, 100}});
        for (int i = 0; i < 5000; ++i) {
            makeBox(world, {3.0 * i - 7500, 0}, moving(i == 0 ? 50 : i % 7, i % 3), {3.25, 3});
        }
        Simulation sim(std::move(world), {.law = Law::Impulse, .resolver = resolver, .threads = 4});
        sim.run(20);
        return stateHash(sim.world());
    };
    EXPECT_EQ(hash(ResolverKind::Threads), hash(ResolverKind::Sequential));
}

TEST(ThreadsInSimulation, BodiesMayComeAndGo) {
    const auto hash = [](ResolverKind resolver) {
        Scene scene = shippedScene("demo13k", 3000);
        Simulation sim(std::move(scene.world),
                       {.law = Law::Impulse, .resolver = resolver, .threads = 3});
        for (int round = 0; round < 6; ++round) {
            sim.run(5);
            World& world = sim.world();
            for (int i = 0; i < 500; ++i) {
                makeBox(world, {double(i % 40) * 4 - 80, double(i / 40) * 4 - 20 + round},
                        moving(i % 9 - 4.0, round), {3, 3});
            }
            if (round % 2 == 1) {
                for (std::uint32_t id = 10; id < 400; id += 3) {
                    if (const Entity entity = world.at(id); world.alive(entity)) {
                        if (!world.get<PhysicsBody>(entity).isStatic) world.destroy(entity);
                    }
                }
            }
        }
        return stateHash(sim.world());
    };
    EXPECT_EQ(hash(ResolverKind::Threads), hash(ResolverKind::Sequential));
}

TEST(ThreadsInSimulation, AnOverflowNamesTheFirstEntity) {
    World world({.size = {1e6, 1e6}});
    for (int i = 0; i < 60'000; ++i) {
        const double speed = i == 31'000 || i == 59'000 ? 1e308 : 1;
        makeBox(world, {double(i % 300) * 10, double(i / 300) * 10}, moving(0, speed));
    }
    Simulation sim(
        std::move(world),
        {.law = Law::Impulse, .resolver = ResolverKind::Threads, .threads = 4, .step = {.dt = 1}});
    try {
        sim.run(10);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("entity 31000:"), std::string::npos)
            << error.what();
    }
}

TEST(ThreadsInSimulation, TwoSimulationsTakeTurns) {
    const auto make = [](int threads) {
        Scene scene = shippedScene("demo13k", 5000);
        return Simulation(
            std::move(scene.world),
            {.law = Law::Impulse, .resolver = ResolverKind::Threads, .threads = threads});
    };
    Simulation first = make(2);
    Simulation second = make(5);
    for (int i = 0; i < 20; ++i) {
        first.step();
        second.step();
    }
    EXPECT_EQ(stateHash(first.world()), stateHash(second.world()));
}

TEST(ThreadsInSimulation, ImpossibleNumbersOfThreadsAreRefused) {
    for (const int threads : {-1, 1025}) {
        EXPECT_THROW(Simulation(World{}, {.resolver = ResolverKind::Threads, .threads = threads}),
                     Error);
    }
    EXPECT_EQ(Simulation(World{}, {.resolver = ResolverKind::Threads}).threads(),
              Simulation::cores());
    EXPECT_EQ(Simulation(World{}, {.threads = 4}).threads(), 1);
}

TEST(ThreadsInSimulation, TheLawBaselineIsNotAvailable) {
    try {
        Simulation sim(World{}, {.law = Law::Baseline, .resolver = ResolverKind::Threads});
        FAIL() << "no error";
    } catch (const NotAvailable& error) {
        EXPECT_NE(std::string(error.what()).find("baseline"), std::string::npos);
    }
}

}  // namespace
}  // namespace quadrille
