// The law `continuous` on the resolver `threads`: what `sequential` gives, bit for bit.

#include <cstdint>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include <quadrille/names.hpp>
#include <quadrille/state_hash.hpp>

#include "collision/continuous/continuous_law.hpp"
#include "collision/random_scene.hpp"
#include "collision/support.hpp"
#include "collision/thread_checks.hpp"
#include "parallel/thread_team.hpp"
#include "sanitized.hpp"

namespace quadrille {
namespace {

class ThreadsContinuous : public testing::TestWithParam<Precision> {};

INSTANTIATE_TEST_SUITE_P(Precisions, ThreadsContinuous,
                         testing::Values(Precision::Double, Precision::Float),
                         [](const auto& test) { return std::string(name(test.param)); });

TEST_P(ThreadsContinuous, RandomScenes) {
    constexpr double restitutions[] = {1, 0.6, 0};
    for (const SceneKind kind : sceneKinds) {
        for (std::uint64_t seed = 202; seed < 202 + scenesOf(7); ++seed) {
            for (std::size_t i = 0; i < completePartitioners.size(); ++i) {
                if (sanitized && (i + seed) % 3 != std::size_t(kind) % 3) continue;
                SCOPED_TRACE(std::string(name(kind)) + ", seed " + std::to_string(seed) +
                             ", partitioner " + std::to_string(i));
                expectTheSameOnThreads([&] { return randomScene(kind, seed, 40, 100); },
                                       {.partitioner = completePartitioners[i],
                                        .law = Law::Continuous,
                                        .precision = GetParam(),
                                        .step = {.gravity = {0, seed % 2 == 0 ? -50.0 : 0.0},
                                                 .restitution = restitutions[seed % 3]}},
                                       8, {threadCounts[(seed + i) % threadCounts.size()]});
                if (HasFailure()) return;
            }
        }
    }
}

/// Integers everywhere: many events at the same time, corner hits, chains, bodies that only touch.
World tiedWorld(std::uint64_t seed, int columns, int spacing) {
    World world({.size = {8.0 * columns, 8.0 * columns}, .seed = seed});
    world.addWalls({.thickness = 20});
    Random& random = world.random();
    for (int i = 0; i < columns * columns; ++i) {
        const Vec2 place(spacing * (i % columns - columns / 2),
                         spacing * (i / columns - columns / 2));
        makeBox(world, place,
                moving(double(2 * random.integer(-1, 1)), double(2 * random.integer(-1, 1))));
    }
    return world;
}

TEST_P(ThreadsContinuous, ALatticeFullOfTies) {
    for (const int spacing : {2, 3, 4}) {
        for (const double dt : {1.0 / 16, 1.0 / 2}) {
            SCOPED_TRACE("spacing " + std::to_string(spacing) + ", dt " + std::to_string(dt));
            expectTheSameOnThreads(
                [&] { return tiedWorld(9, 12, spacing); },
                {.law = Law::Continuous, .precision = GetParam(), .step = {.dt = dt}},
                dt < 0.1 ? 40 : 12, threadCounts);
            if (HasFailure()) return;
        }
    }
}

TEST_P(ThreadsContinuous, HeavyBodiesMakeLightOnesTooFastForTheIslands) {
    // In each group a heavy body drives a lighter one against one that is lighter still, which
    // leaves at nearly three times the speed, and meets the next group before the step ends.
    const auto world = [] {
        World w({.size = {2000, 400}, .seed = 3});
        for (int i = 0; i < 60; ++i) {
            const Vec2 place(60.0 * (i % 20) - 600, 24.0 * (i / 20) - 30);
            makeBox(w, place, moving(60 + i, 0, 20), {4, 4});
            makeBox(w, place + Vec2(5 + i % 3, 1), moving(0, 0, 4), {4, 4});
            makeBox(w, place + Vec2(10 + i % 5, 0), moving(0, 0, 1), {4, 4});
        }
        return w;
    };
    expectTheSameOnThreads(
        world, {.law = Law::Continuous, .precision = GetParam(), .step = {.dt = 1.0 / 15}}, 3,
        {2, 7});
}

/// Heaps that fall onto platforms of their own, which are islands as long as nothing falls off.
World heapsOnPlatforms() {
    World world({.size = {2000, 400}, .seed = 5});
    Random& random = world.random();
    for (int platform = 0; platform < 24; ++platform) {
        const Vec2 place(80.0 * (platform % 12) - 440, platform < 12 ? 0 : -120);
        makeBox(world, place, fixed(), {30, 4});
        for (int i = 0; i < 18; ++i) {
            makeBox(
                world, place + Vec2(7.0 * (i % 3) - 7 + random.uniform(-1, 1), 8 + 7.0 * (i / 3)),
                moving(random.uniform(-3, 3), random.uniform(-20, 0), i % 5 == 0 ? 7 : 1), {6, 6});
        }
    }
    return world;
}

TEST_P(ThreadsContinuous, HeapsThatLoseWhatHoldsThem) {
    for (const double restitution : {0.0, 0.4, 1.0}) {
        SCOPED_TRACE("restitution " + std::to_string(restitution));
        const auto edit = [](World& world, std::uint64_t number) {
            if (number < 60 || number % 7 != 0) return;
            const Entity platform = world.at(static_cast<std::uint32_t>(19 * (number % 24)));
            if (world.alive(platform)) world.destroy(platform);
        };
        expectTheSameOnThreads(heapsOnPlatforms,
                               {.law = Law::Continuous,
                                .precision = GetParam(),
                                .step = {.gravity = {0, -200}, .restitution = restitution}},
                               90, {2, 7}, edit);
        if (HasFailure()) return;
    }
}

TEST_P(ThreadsContinuous, AnEditedWorld) {
    const auto edit = [](World& world, std::uint64_t number) {
        if (number % 3 != 0) return;
        for (int i = 0; i < 20; ++i) {
            makeBox(world, {double(i % 5) * 4 - 30 + double(number), double(i / 5) * 4 - 20},
                    moving(i % 9 - 4.0, double(number)), {3, 3});
        }
        for (std::uint32_t id = 5 + static_cast<std::uint32_t>(number); id < 80; id += 7) {
            const Entity entity = world.at(id);
            if (!world.alive(entity) || world.get<PhysicsBody>(entity).isStatic) continue;
            if (id % 2 == 0) {
                world.destroy(entity);
            } else {
                PhysicsBody body = world.get<PhysicsBody>(entity);
                body.velocity += Vec2(40, -30);
                world.set(entity, body);
            }
        }
    };
    for (const PartitionerConfig& partitioner : completePartitioners) {
        SCOPED_TRACE(name(partitioner));
        expectTheSameOnThreads(
            [] { return shippedScene("demo13k", 300).world; },
            {.partitioner = partitioner, .law = Law::Continuous, .precision = GetParam()}, 12,
            {3, 16}, edit);
        if (HasFailure()) return;
    }
}

// ---- scenes from files

struct File {
    std::string scene;  ///< a shipped one, or the path of a golden one
    std::uint64_t entities;
    std::uint64_t steps;
};

std::ostream& operator<<(std::ostream& out, const File& f) {
    return out << f.scene << ", " << f.entities << " entities";
}

class ThreadsContinuousFiles : public testing::TestWithParam<std::tuple<File, Precision>> {};

TEST_P(ThreadsContinuousFiles, EveryPartitionerAndNumberOfThreads) {
    const auto& [file, precision] = GetParam();
    const auto load = [&, count = file.entities, scene = file.scene] {
        if (scene.find('/') != std::string::npos) {
            return loadScene(QUADRILLE_TEST_DATA "/" + scene + ".toml");
        }
        return count > 0 ? shippedScene(scene, count) : shippedScene(scene);
    };
    const StepSettings step = load().step;
    for (std::size_t i = 0; i < completePartitioners.size(); ++i) {
        SCOPED_TRACE("partitioner " + std::to_string(i));
        expectTheSameOnThreads([&] { return load().world; },
                               {.partitioner = completePartitioners[i],
                                .law = Law::Continuous,
                                .precision = precision,
                                .step = step},
                               file.steps, threadCountsOf(i + 1));
        if (HasFailure()) return;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Threads, ThreadsContinuousFiles,
    testing::Combine(testing::Values(File{"balanced", 300, 12}, File{"balanced-scaled", 300, 12},
                                     File{"bullet", 0, 12}, File{"cradle", 0, 12},
                                     File{"demo13k", 300, 12}, File{"imbalanced", 20, 4},
                                     File{"mixed-sizes", 300, 12}, File{"pi", 0, 3},
                                     File{"pile", 100, 8}, File{"golden/A1700", 0, 4},
                                     File{"golden/dense1600", 0, 4}, File{"golden/small64", 0, 20}),
                     testing::Values(Precision::Double, Precision::Float)),
    [](const auto& test) {
        std::string text =
            std::get<0>(test.param).scene + "In" + std::string(name(std::get<1>(test.param)));
        std::erase_if(text, [](char c) { return c == '-' || c == '/'; });
        return text;
    });

// ---- where it is worth it

TEST(ThreadsContinuousGate, EventsWhereBodiesCanHeapUpAreSharedOutByMoreThreads) {
    // What shares events out takes memory.
    const auto bytes = [](unsigned threads, const StepSettings& step) {
        const ThreadTeam team(threads);
        return makeContinuousLaw<double>({.law = Law::Continuous, .step = step}, team)->bytes();
    };
    const unsigned enough = Thresholds{}.heapThreads;
    ASSERT_GT(enough, 2u);
    for (const StepSettings& heaps :
         {StepSettings{.gravity = {0, -10}}, StepSettings{.restitution = 0.5}}) {
        EXPECT_EQ(bytes(1, heaps), bytes(1, {}));
        EXPECT_LT(bytes(enough - 1, heaps), bytes(enough - 1, {}));
        EXPECT_EQ(bytes(enough, heaps), bytes(enough, {}));
    }
}

// ---- through the public interface, where short loops stay on one thread

Simulation simulationOn(ResolverKind resolver, int threads, Scene scene) {
    return Simulation(
        std::move(scene.world),
        {.law = Law::Continuous, .resolver = resolver, .threads = threads, .step = scene.step});
}

TEST(ThreadsContinuousInSimulation, LargeScenesEndInTheSameState) {
    for (const auto& [scene, entities, steps] :
         {std::tuple("demo13k", 12'000, 60), std::tuple("balanced", 30'000, 40),
          std::tuple("mixed-sizes", 5'000, 40), std::tuple("pile", 300, 20)}) {
        SCOPED_TRACE(scene);
        const auto hash = [&](ResolverKind resolver, int threads) {
            Simulation sim = simulationOn(
                resolver, threads, shippedScene(scene, static_cast<std::uint64_t>(entities)));
            sim.run(static_cast<std::uint64_t>(steps));
            return stateHash(sim.world());
        };
        const std::uint64_t expected = hash(ResolverKind::Sequential, 0);
        EXPECT_EQ(hash(ResolverKind::Threads, 2), expected);
        EXPECT_EQ(hash(ResolverKind::Threads, 5), expected);
    }
}

TEST(ThreadsContinuousInSimulation, TheResolverMayChangeDuringTheRun) {
    const auto hash = [](bool change) {
        Simulation sim = simulationOn(ResolverKind::Sequential, 0, shippedScene("demo13k", 3000));
        for (int round = 0; round < 4; ++round) {
            if (change) {
                SimulationConfig config = sim.config();
                config.resolver = round % 2 == 0 ? ResolverKind::Threads : ResolverKind::Sequential;
                config.threads = 3;
                sim.reconfigure(config);
            }
            sim.run(15);
        }
        return stateHash(sim.world());
    };
    EXPECT_EQ(hash(true), hash(false));
}

}  // namespace
}  // namespace quadrille
