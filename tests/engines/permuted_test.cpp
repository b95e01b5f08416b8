// Rows are places in storage and nothing else: with the rows of a world in any order, before the
// first step or from the middle of a run on, every step gives the same bits, counts and contacts.
// Storage may so be sorted along a curve or split over devices.
//
// The law `baseline` is no part of this: it resolves pairs in the order of its cells, in which
// bodies lie by rows.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <quadrille/creation_ranks.hpp>
#include <quadrille/measure.hpp>
#include <quadrille/names.hpp>
#include <quadrille/snapshot.hpp>
#include <quadrille/state_hash.hpp>

#include "collision/random_scene.hpp"
#include "collision/support.hpp"
#include "core/step_times.hpp"
#include "core/world_access.hpp"
#include "engines/host_engine.hpp"
#include "sanitized.hpp"
#include "shuffled.hpp"

namespace quadrille {
namespace {

void permute(World& world, Random& random) {
    WorldAccess::permute(world, shuffled(world.movingCount(), random),
                         shuffled(world.staticCount(), random));
}

/// A contact with the bodies by their places in the order of creation; static ones from -1 down.
using Numbered = std::tuple<double, std::int64_t, std::int64_t, int, int, int, bool, double, double,
                            double, double>;

/// All that a step shows of itself, but for the cells, which hold rows.
struct Seen {
    std::uint64_t hash, contacts, collisions, pairsTested, overlappingPairs;
    std::size_t cells, entries;
    double energy;
    std::vector<Numbered> records;
};

template <class Real>
std::vector<Numbered> numbered(const World& world, std::span<const ContactRecord> records) {
    const BodyView<Real> bodies = world.bodies<Real>();
    const CreationRanks moving(bodies.moving.created, bodies.moving.size());
    const CreationRanks fixed(bodies.fixed.created, bodies.fixed.size());
    std::vector<Numbered> result;
    for (const ContactRecord& r : records) {
        const std::int64_t b = r.b.isStatic() ? -1 - static_cast<std::int64_t>(fixed[r.b.row()])
                                              : static_cast<std::int64_t>(moving[r.b.row()]);
        result.emplace_back(r.time, static_cast<std::int64_t>(moving[r.a]), b, r.axes, r.senseX,
                            r.senseY, r.collided, r.impulseX, r.impulseY, r.approachX, r.approachY);
    }
    return result;
}

struct Scenario {
    std::function<World()> world;
    SimulationConfig config;
    int steps = 0;
};

/// `before(world, number)` is called ahead of each step, from 1.
template <class Real>
std::vector<Seen> stepsIn(const Scenario& run, const std::function<void(World&, int)>& before) {
    World world = run.world();
    world.setPrecision(run.config.precision);
    HostEngine<Real> engine(run.config, world.config().size, Thresholds::none());
    const StepTimes times(run.config.step.dt);
    std::vector<Seen> result;
    for (int i = 1; i <= run.steps; ++i) {
        before(world, i);
        const auto number = static_cast<std::uint64_t>(i);
        StepWindow window{.number = number,
                          .from = times.at(number - 1),
                          .to = times.at(number),
                          .keepContacts = true};
        StepReport report;
        engine.step(WorldAccess::store(world), window, report);
        result.push_back({stateHash(world), report.contacts, report.collisions, report.pairsTested,
                          report.overlappingPairs, engine.cells().size(),
                          engine.cells().bodies.size(), kineticEnergy(world),
                          numbered<Real>(world, engine.contacts())});
    }
    EXPECT_EQ(world.validate().size(), 0u);
    return result;
}

std::vector<Seen> stepsOf(const Scenario& run, const std::function<void(World&, int)>& before) {
    return run.config.precision == Precision::Double ? stepsIn<double>(run, before)
                                                     : stepsIn<float>(run, before);
}

/// `sameCells` where these were made in the same step.
void expectEqual(const Seen& seen, const Seen& expected, bool sameCells) {
    EXPECT_EQ(seen.hash, expected.hash);
    EXPECT_EQ(seen.energy, expected.energy);
    EXPECT_EQ(seen.contacts, expected.contacts);
    EXPECT_EQ(seen.collisions, expected.collisions);
    EXPECT_EQ(seen.overlappingPairs, expected.overlappingPairs);
    if (sameCells) {
        EXPECT_EQ(seen.pairsTested, expected.pairsTested);
        EXPECT_EQ(seen.cells, expected.cells);
        EXPECT_EQ(seen.entries, expected.entries);
    }
    ASSERT_EQ(seen.records.size(), expected.records.size());
    for (std::size_t i = 0; i < seen.records.size(); ++i) {
        ASSERT_TRUE(seen.records[i] == expected.records[i])
            << "contact " << i << ": of " << std::get<1>(seen.records[i]) << " and "
            << std::get<2>(seen.records[i]) << ", expected " << std::get<1>(expected.records[i])
            << " and " << std::get<2>(expected.records[i]);
    }
}

/// Expects the same of a run whose rows are permuted before some of its steps.
void expectTheSamePermuted(const Scenario& run, std::uint64_t seed) {
    const auto expected = stepsOf(run, [](World&, int) {});
    for (const std::vector<int>& at :
         std::vector<std::vector<int>>{{1}, {run.steps / 2}, {1, 2, 4}}) {
        SCOPED_TRACE("permuted before step " + std::to_string(at.back()) + ", seed " +
                     std::to_string(seed));
        const auto here = [&](int step) {
            return std::find(at.begin(), at.end(), step) != at.end();
        };
        for (const auto& [resolver, threads] :
             {std::pair(ResolverKind::Sequential, 1), std::pair(ResolverKind::Threads, 3)}) {
            SCOPED_TRACE(std::string(name(resolver)));
            Scenario permuted = run;
            permuted.config.resolver = resolver;
            permuted.config.threads = threads;
            // Where cells are kept for several steps, to permute is to make them anew.
            const bool sameCells =
                at == std::vector<int>{1} ||
                (run.config.law != Law::Continuous &&
                 !std::holds_alternative<SemiStaticQuadtree>(run.config.partitioner));
            Random random(seed);
            const auto seen = stepsOf(permuted, [&](World& world, int step) {
                if (here(step)) permute(world, random);
            });
            for (std::size_t i = 0; i < seen.size(); ++i) {
                SCOPED_TRACE("step " + std::to_string(i + 1));
                ASSERT_NO_FATAL_FAILURE(expectEqual(seen[i], expected[i], sameCells));
                if (testing::Test::HasFailure()) return;
            }
        }
    }
}

const std::vector<PartitionerConfig> partitioners = {
    Quadtree{6, 4}, StaticGrid{{9, 14}}, SemiStaticQuadtree{6, 4},
    SemiStaticQuadtree{6, 4, SemiStaticQuadtree::Skin{2}}};

class Permuted : public testing::TestWithParam<std::tuple<Law, Precision>> {
  protected:
    SimulationConfig config(const PartitionerConfig& partitioner, const StepSettings& step) const {
        return {.partitioner = partitioner,
                .law = std::get<0>(GetParam()),
                .precision = std::get<1>(GetParam()),
                .step = step,
                // The exact law audits the partitions that it asks for, which permuting adds to.
                .countMissedPairs = std::get<0>(GetParam()) != Law::Continuous};
    }
    void expectTheSame(const std::function<World()>& world, const StepSettings& step, int steps,
                       std::uint64_t seed) const {
        for (std::size_t i = 0; i < partitioners.size(); ++i) {
            SCOPED_TRACE(std::string(name(partitioners[i])) + ", number " + std::to_string(i));
            expectTheSamePermuted({world, config(partitioners[i], step), steps}, seed);
            if (testing::Test::HasFailure()) return;
        }
    }
};

INSTANTIATE_TEST_SUITE_P(Laws, Permuted,
                         testing::Combine(testing::Values(Law::Impulse, Law::Continuous),
                                          testing::Values(Precision::Double, Precision::Float)),
                         [](const auto& test) {
                             return std::string(name(std::get<0>(test.param))) + "In" +
                                    std::string(name(std::get<1>(test.param)));
                         });

TEST_P(Permuted, RandomScenes) {
    for (const SceneKind kind : sceneKinds) {
        for (std::uint64_t seed = 202; seed < (sanitized ? 204 : 206); ++seed) {
            SCOPED_TRACE(std::string(name(kind)) + ", scene " + std::to_string(seed));
            expectTheSame(
                [&] { return randomScene(kind, seed, 40, 100); },
                {.gravity = {0, seed == 202 ? -50.0 : 0.0}, .restitution = seed == 203 ? 0.6 : 1},
                8, 1000 + seed);
            if (HasFailure()) return;
        }
    }
}

/// Integers everywhere: many contacts at the same time, corner hits, and entities whose ids were
/// used before, so that ties are not broken by ids that happen to lie as the rows do.
World tied(int columns) {
    World world({.size = {8.0 * columns, 8.0 * columns}, .seed = 4});
    std::vector<Entity> early;
    for (int i = 0; i < columns * columns / 2; ++i) early.push_back(makeBox(world, {0, 0}));
    for (const Entity entity : early) world.destroy(entity);
    world.flush();
    world.addWalls({.thickness = 20});
    Random& random = world.random();
    for (int i = 0; i < columns * columns; ++i) {
        const Vec2 place(3 * (i % columns - columns / 2), 3 * (i / columns - columns / 2));
        makeBox(world, place,
                moving(double(2 * random.integer(-1, 1)), double(2 * random.integer(-1, 1))));
    }
    return world;
}

TEST_P(Permuted, ALatticeFullOfTies) {
    expectTheSame([] { return tied(9); }, {.dt = 1.0 / 2}, 8, 21);
}

TEST_P(Permuted, BodiesAtTheSamePlace) {
    // Which of two goes to which side is decided by who was created first.
    const auto world = [] {
        World w({.size = {100, 100}});
        for (int i = 0; i < 12; ++i) makeBox(w, {5, 5}, moving(i % 3 - 1, i % 2), {4, 4});
        makeBox(w, {5, 5}, fixed(), {4, 4});
        makeBox(w, {5, 5}, fixed(), {4, 4});
        return w;
    };
    expectTheSame(world, {}, 10, 22);
}

TEST_P(Permuted, ShippedScenes) {
    for (const auto& [scene, entities] :
         {std::pair("mixed-sizes", 150), std::pair("pile", 80), std::pair("imbalanced", 10)}) {
        SCOPED_TRACE(scene);
        const auto load = [scene = scene, count = entities] {
            return shippedScene(scene, static_cast<std::uint64_t>(count));
        };
        expectTheSame([&] { return load().world; }, load().step, 8, 23);
        if (HasFailure()) return;
    }
}

TEST_P(Permuted, BodiesComeAndGoInAPermutedWorld) {
    // Both worlds are edited alike; the rows of one are permuted at the start and later on.
    const auto edit = [](World& world, int step) {
        if (step % 2 == 0) return;
        for (std::uint32_t id = 5 + static_cast<std::uint32_t>(step); id < 60; id += 7) {
            const Entity entity = world.at(id);
            if (!world.alive(entity)) continue;
            if (id % 3 == 0) {
                world.destroy(entity);
            } else if (!world.get<PhysicsBody>(entity).isStatic) {
                world.set(entity, moving(40, -30));
            }
        }
        world.flush();
        for (int i = 0; i < 6; ++i) makeBox(world, {4.0 * i - 20, double(step)}, moving(i, step));
    };
    for (const PartitionerConfig& partitioner : partitioners) {
        SCOPED_TRACE(name(partitioner));
        const Scenario run{[] { return randomScene(SceneKind::Uniform, 310, 70, 100); },
                           config(partitioner, {}), 9};
        const auto expected = stepsOf(run, edit);
        Random random(24);
        const auto seen = stepsOf(run, [&](World& world, int step) {
            if (step == 1 || step == 6) permute(world, random);
            edit(world, step);
        });
        for (std::size_t i = 0; i < seen.size(); ++i) {
            SCOPED_TRACE("step " + std::to_string(i + 1));
            ASSERT_NO_FATAL_FAILURE(expectEqual(seen[i], expected[i], false));
        }
        if (HasFailure()) return;
    }
}

// ---- through the public interface

TEST_P(Permuted, ContactsOfASimulationNameTheSameBodies) {
    const auto contacts = [&](bool permuted) {
        SimulationConfig c = config(Quadtree{}, {});
        c.keepContacts = true;
        World world = randomScene(SceneKind::Clustered, 43, 120, 100);
        Random random(25);
        if (permuted) permute(world, random);
        Simulation sim(std::move(world), c);
        std::vector<std::tuple<double, Entity, Entity, std::int64_t, std::int64_t>> seen;
        for (int i = 0; i < 8; ++i) {
            sim.step();
            for (const Contact& k : sim.contacts()) {
                seen.emplace_back(k.time, k.a, k.b, k.numberA, k.numberB);
            }
        }
        return seen;
    };
    const auto expected = contacts(false);
    ASSERT_GT(expected.size(), 100u);
    EXPECT_TRUE(contacts(true) == expected);
}

TEST_P(Permuted, ASnapshotKeepsTheOrderOfCreation) {
    World world = randomScene(SceneKind::Uniform, 44, 80, 100);
    Random random(26);
    permute(world, random);
    Simulation sim(std::move(world), config(Quadtree{}, {}));
    sim.run(3);
    const Snapshot snapshot = sim.snapshot();
    snapshot.world.visitBodies(
        [](const auto& bodies) { EXPECT_FALSE(bodies.moving.created.isRowOrder()); });
    sim.run(5);
    const std::uint64_t expected = stateHash(sim.world());
    sim.restore(snapshot);
    sim.run(5);
    EXPECT_EQ(stateHash(sim.world()), expected);
}

}  // namespace
}  // namespace quadrille
