// One scene, law, precision and number of steps: one hash of the state, whatever the partitioner.

#include <cstdint>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include <quadrille/names.hpp>
#include <quadrille/snapshot.hpp>
#include <quadrille/state_hash.hpp>

#include "collision/random_scene.hpp"
#include "collision/support.hpp"
#include "sanitized.hpp"

namespace quadrille {
namespace {

using Skin = SemiStaticQuadtree::Skin;

std::uint64_t hashAfter(Simulation sim, std::uint64_t steps) {
    sim.run(steps);
    return stateHash(sim.world());
}

struct Case {
    std::string scene;
    std::uint64_t entities;
    std::uint64_t steps;
    std::vector<PartitionerConfig> partitioners;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
    return out << c.scene << ", " << c.entities << " entities, " << c.steps << " steps";
}

const std::vector<PartitionerConfig> all = {StaticGrid{},
                                            StaticGrid{{100, 31}},
                                            Quadtree{},
                                            Quadtree{6, 4},
                                            SemiStaticQuadtree{},
                                            SemiStaticQuadtree{8, 12, Skin{1.5}},
                                            SemiStaticQuadtree{6, 20, Skin{5}}};

const std::vector<PartitionerConfig> fast = {StaticGrid{}, Quadtree{}, SemiStaticQuadtree{}};

const std::vector<PartitionerConfig> fastAndOracle = {StaticGrid{}, Quadtree{},
                                                      SemiStaticQuadtree{}, BruteForce{}};

class Determinism : public testing::TestWithParam<std::tuple<Case, Precision>> {};

TEST_P(Determinism, EveryPartitionerGivesTheSameState) {
    const auto& [c, precision] = GetParam();
    const std::uint64_t steps = stepsOf(c.steps);
    const auto hash = [&](const PartitionerConfig& partitioner) {
        return hashAfter(simulationOf(shippedScene(c.scene, c.entities), partitioner, precision),
                         steps);
    };
    const std::uint64_t expected = hash(c.partitioners.front());
    EXPECT_NE(expected,
              hashAfter(simulationOf(shippedScene(c.scene, c.entities), StaticGrid{}, precision),
                        steps - 1));
    for (std::size_t i = 1; i < c.partitioners.size(); ++i) {
        SCOPED_TRACE(std::string(name(c.partitioners[i])) + ", number " + std::to_string(i));
        EXPECT_EQ(hash(c.partitioners[i]), expected);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Determinism,
    testing::Combine(testing::Values(Case{"balanced", 2000, 1000, all},
                                     Case{"balanced", 500, 1000, fastAndOracle},
                                     Case{"balanced", 10000, 1000, fast},
                                     Case{"imbalanced", 200, 1000, all},
                                     Case{"imbalanced", 200, 100, fastAndOracle},
                                     Case{"mixed-sizes", 600, 1000, all},
                                     Case{"mixed-sizes", 400, 200, fastAndOracle},
                                     Case{"pile", 300, 1000, all},
                                     Case{"pile", 300, 200, fastAndOracle}),
                     testing::Values(Precision::Double, Precision::Float)),
    [](const auto& test) {
        const Case& c = std::get<0>(test.param);
        std::string text = c.scene + std::to_string(c.entities) + "For" + std::to_string(c.steps) +
                           "In" + std::string(name(std::get<1>(test.param)));
        std::erase(text, '-');
        return text;
    });

class RandomDeterminism : public testing::TestWithParam<Precision> {};

INSTANTIATE_TEST_SUITE_P(Precisions, RandomDeterminism,
                         testing::Values(Precision::Double, Precision::Float),
                         [](const auto& test) { return std::string(name(test.param)); });

TEST_P(RandomDeterminism, RandomScenesGiveTheSameStateWithEveryPartitioner) {
    for (const SceneKind kind : sceneKinds) {
        for (std::uint64_t seed = 0; seed < scenesOf(6); ++seed) {
            SCOPED_TRACE(std::string(name(kind)) + ", seed " + std::to_string(seed));
            const auto hash = [&](const PartitionerConfig& partitioner) {
                return hashAfter(Simulation(randomScene(kind, seed, 80),
                                            {.partitioner = partitioner,
                                             .law = Law::Impulse,
                                             .precision = GetParam(),
                                             .step = {.gravity = {0, seed % 2 == 0 ? 0.0 : -50.0},
                                                      .restitution = seed % 3 == 0 ? 1 : 0.6}}),
                                 stepsOf(100));
            };
            const std::uint64_t expected = hash(BruteForce{});
            for (const PartitionerConfig& partitioner : all) {
                ASSERT_EQ(hash(partitioner), expected) << name(partitioner);
            }
        }
    }
}

TEST_P(RandomDeterminism, ChangingThePartitionerOnTheWayChangesNothing) {
    const auto scene = [] { return shippedScene("imbalanced", 50); };
    const std::uint64_t expected =
        hashAfter(simulationOf(scene(), Quadtree{}, GetParam()), 10 * all.size());
    Simulation sim = simulationOf(scene(), BruteForce{}, GetParam());
    for (const PartitionerConfig& partitioner : all) {
        sim.setPartitioner(partitioner);
        sim.run(10);
    }
    EXPECT_EQ(stateHash(sim.world()), expected);
}

/// The exact law places bodies only when somebody wants to see them; whoever looks, edits nothing.
TEST_P(RandomDeterminism, LookingChangesNothing) {
    for (const std::string scene : {"balanced", "mixed-sizes", "pile"}) {
        SCOPED_TRACE(scene);
        const auto begin = [&](Law law) {
            Scene from = shippedScene(scene, 300);
            return Simulation(std::move(from.world), {.partitioner = SemiStaticQuadtree{},
                                                      .law = law,
                                                      .precision = GetParam(),
                                                      .resolver = ResolverKind::Sequential,
                                                      .step = from.step});
        };
        Simulation seen = begin(Law::Continuous);
        std::vector<std::uint64_t> expected;
        for (int i = 0; i < 60; ++i) {
            seen.step();
            expected.push_back(stateHash(seen.world()));
        }
        Simulation unseen = begin(Law::Continuous);
        unseen.run(20);
        EXPECT_EQ(stateHash(unseen.world()), expected[19]);
        unseen.run(5);
        unseen.setPartitioner(StaticGrid{});
        unseen.run(15);
        EXPECT_EQ(stateHash(unseen.snapshot().world), expected[39]);
        unseen.run(5);
        unseen.restore(unseen.snapshot());
        unseen.run(15);
        EXPECT_EQ(stateHash(unseen.world()), expected[59]);
        // And so does another law, which goes by the columns.
        for (Simulation* sim : {&seen, &unseen}) {
            sim->run(3);
            if (sim == &seen) stateHash(sim->world());
            SimulationConfig config = sim->config();
            config.law = Law::Impulse;
            sim->reconfigure(config);
            sim->run(3);
        }
        EXPECT_EQ(stateHash(unseen.world()), stateHash(seen.world()));
    }
}

}  // namespace
}  // namespace quadrille
