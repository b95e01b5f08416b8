// The report's policy, rebuild every K frames without a skin, misses pairs, and they are counted.

#include "collision/pairs/missed_pairs.hpp"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/names.hpp>
#include <quadrille/state_hash.hpp>

#include "collision/broad/partition_checks.hpp"
#include "collision/random_scene.hpp"
#include "collision/support.hpp"
#include "reals.hpp"

namespace quadrille {
namespace {

using EveryFrames = SemiStaticQuadtree::EveryFrames;
using Skin = SemiStaticQuadtree::Skin;

SimulationConfig counting(const PartitionerConfig& partitioner,
                          Precision precision = Precision::Double) {
    return {.partitioner = partitioner,
            .law = Law::Impulse,
            .precision = precision,
            .step = {.dt = 1.0 / 64},
            .countMissedPairs = true};
}

/// Two boxes of 2 x 2 that approach by 1 px a step from a distance of 16: they overlap at the ends
/// of steps 15, 16 and 17 (distances 1, 0, 1; level edges at 14 and 18 do not count).
World approaching() {
    World world({.size = {64, 64}});
    makeBox(world, {-8, 1}, moving(32));
    makeBox(world, {8, 1}, moving(-32));
    return world;
}

/// Calls `sees(positions, cells)` in each step with the boxes as the narrow phase saw them, before
/// the contacts moved them, and the cells of the step.
template <class Real, class Function>
void run(Simulation& sim, int steps, Function&& sees) {
    for (int i = 0; i < steps; ++i) {
        const auto view = sim.world().template bodies<Real>();
        Boxes<Real> boxes(view);
        for (std::size_t row = 0; row < view.moving.size(); ++row) {
            boxes.x[row] += view.moving.vx[row] * static_cast<Real>(sim.config().step.dt);
            boxes.y[row] += view.moving.vy[row] * static_cast<Real>(sim.config().step.dt);
        }
        const StepReport report = sim.step();
        sees(boxes, report);
        if (testing::Test::HasFatalFailure()) return;
    }
}

/// The overlapping pairs of which no cell holds both bodies.
template <class Real>
std::uint64_t unseen(const Boxes<Real>& boxes, const Cells& cells) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> together;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const auto members = cells[c];
        for (std::size_t i = 0; i < members.size(); ++i) {
            for (std::size_t j = i + 1; j < members.size(); ++j) {
                together.emplace(boxes.numberOf(members[i]), boxes.numberOf(members[j]));
            }
        }
    }
    const PairList pairs = overlappingPairs(boxes);
    return static_cast<std::uint64_t>(std::count_if(
        pairs.begin(), pairs.end(), [&](const auto& pair) { return !together.contains(pair); }));
}

TEST(MissedPairs, AreCountedForAsLongAsTheTreeIsStale) {
    // Built in step 1, with the bodies in different cells, and again in step 21.
    Simulation sim(approaching(), counting(SemiStaticQuadtree{5, 1, EveryFrames{20}}));
    for (std::uint64_t step = 1; step <= 25; ++step) {
        SCOPED_TRACE(step);
        const StepReport report = sim.step();
        EXPECT_EQ(report.rebuilt, step == 1 || step == 21);
        EXPECT_EQ(report.missedPairs, step >= 15 && step <= 17 ? 1u : 0u);
        EXPECT_EQ(report.contacts, 0u);
    }
}

TEST(MissedPairs, EndWithTheNextBuild) {
    // Built in steps 1 and 16: missed in step 15, found in step 16, and pushed apart there.
    Simulation sim(approaching(), counting(SemiStaticQuadtree{5, 1, EveryFrames{15}}));
    for (std::uint64_t step = 1; step <= 20; ++step) {
        SCOPED_TRACE(step);
        const StepReport report = sim.step();
        EXPECT_EQ(report.missedPairs, step == 15 ? 1u : 0u);
        EXPECT_EQ(report.contacts, step == 16 ? 1u : 0u);
    }
}

TEST(MissedPairs, AreThoseOfStaticBodiesToo) {
    World world({.size = {64, 64}});
    makeBox(world, {-8, 1}, moving(64));
    makeBox(world, {8, 1}, fixed());
    Simulation sim(std::move(world), counting(SemiStaticQuadtree{5, 1, EveryFrames{20}}));
    std::uint64_t missed = 0;
    for (int i = 0; i < 20; ++i) missed += sim.step().missedPairs;
    EXPECT_EQ(missed, 3u);  // at distances 1, 0 and 1
}

TEST(MissedPairs, AreNotCountedUnlessAskedFor) {
    SimulationConfig config = counting(SemiStaticQuadtree{5, 1, EveryFrames{20}});
    config.countMissedPairs = false;
    Simulation sim(approaching(), config);
    for (int i = 0; i < 20; ++i) {
        const StepReport report = sim.step();
        EXPECT_EQ(report.missedPairs, 0u);
        EXPECT_FALSE(report.audited);
    }
}

TEST(MissedPairs, AreCountedInASampleOfTheSteps) {
    SimulationConfig config = counting(SemiStaticQuadtree{5, 1, EveryFrames{10}});
    config.missedPairsEvery = 10;
    World world({.size = {64, 64}});
    makeBox(world, {-8, 1}, moving(0.125));
    makeBox(world, {-8, 1}, fixed());  // overlap throughout
    Simulation sim(std::move(world), config);
    std::set<std::uint64_t> phases;  // of the tree's age
    int audited = 0;
    for (std::uint64_t step = 1; step <= 1000; ++step) {
        const StepReport report = sim.step();
        EXPECT_TRUE(report.audited || step > 1) << "the first step is always one of them";
        EXPECT_EQ(report.missedPairs, 0u);
        audited += report.audited;
        if (report.audited) phases.insert(step % 10);
    }
    // Binomial with mean 100 and deviation 9.5; the sample is the same in every run.
    EXPECT_GT(audited, 60);
    EXPECT_LT(audited, 140);
    EXPECT_EQ(phases.size(), 10u);
}

TEST(MissedPairs, AreNotCountedInOneStepOfNone) {
    SimulationConfig config = counting(Quadtree{});
    config.missedPairsEvery = 0;
    EXPECT_THROW(Simulation(approaching(), config), Error);
}

template <class Real>
class MissedPairsIn : public testing::Test {
  protected:
    static World scene(std::uint64_t seed) {
        World world =
            randomScene(seed % 2 == 0 ? SceneKind::Uniform : SceneKind::Clustered, seed, 100, 150);
        world.setPrecision(precisionOf<Real>);
        return world;
    }
};

TYPED_TEST_SUITE(MissedPairsIn, Reals, RealNames);

TYPED_TEST(MissedPairsIn, RandomScenesAreCountedAsByHand) {
    using Real = TypeParam;
    std::uint64_t total = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const int frames = static_cast<int>(2 + seed % 9);
        Simulation sim(this->scene(seed),
                       counting(SemiStaticQuadtree{7, 3, EveryFrames{frames}}, precisionOf<Real>));
        run<Real>(sim, 40, [&](const Boxes<Real>& boxes, const StepReport& report) {
            ASSERT_TRUE(report.audited);
            ASSERT_EQ(report.overlappingPairs, overlappingPairs(boxes).size());
            ASSERT_EQ(report.missedPairs, unseen(boxes, sim.cells())) << "step " << report.step;
            ASSERT_EQ(report.contacts + report.missedPairs, overlappingPairs(boxes).size());
            total += report.missedPairs;
        });
    }
    EXPECT_GT(total, 100u);
}

TYPED_TEST(MissedPairsIn, CompletePartitionsAreNone) {
    using Real = TypeParam;
    const std::vector<PartitionerConfig> configs = {BruteForce{},
                                                    StaticGrid{{9, 14}},
                                                    Quadtree{7, 3},
                                                    SemiStaticQuadtree{7, 3},
                                                    SemiStaticQuadtree{7, 3, Skin{3}},
                                                    SemiStaticQuadtree{7, 3, EveryFrames{1}}};
    for (const PartitionerConfig& config : configs) {
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            SCOPED_TRACE(std::string(name(config)) + ", seed " + std::to_string(seed));
            Simulation sim(this->scene(seed), counting(config, precisionOf<Real>));
            run<Real>(sim, 30, [&](const Boxes<Real>& boxes, const StepReport& report) {
                ASSERT_EQ(report.missedPairs, 0u);
                ASSERT_EQ(report.contacts, overlappingPairs(boxes).size());
            });
        }
    }
}

/// Bodies may move before the law `continuous` has the cells built again, so the pairs that count
/// are those that come within reach.
TYPED_TEST(MissedPairsIn, ThoseWithinReachAreCountedAsByHand) {
    using Real = TypeParam;
    const Real reach = 1.5;
    std::uint64_t missed = 0;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        World world = this->scene(seed);
        const auto bodies = world.template bodies<Real>();
        for (const bool covered : {false, true}) {
            const auto partitioner = makePartitioner<Real>(Quadtree{7, 3}, world.config().size);
            partitioner->update(bodies, Real(0), covered ? reach : Real(0));
            Boxes<Real> inflated(bodies);
            for (std::uint32_t i = 0; i < inflated.size(); ++i) {
                inflated.halfWidth[i] += reach;
                inflated.halfHeight[i] += reach;
            }
            const PairAudit audit =
                MissedPairCounter<Real>(1).count(bodies, partitioner->partition(), reach);
            EXPECT_EQ(audit.overlapping, overlappingPairs(inflated).size());
            // A cell in common alone does not show a pair that the cells were not made for.
            const std::uint64_t apart = unseen(inflated, partitioner->partition().cells);
            EXPECT_GE(audit.missed, apart);
            EXPECT_EQ(audit.missed > 0, apart > 0);
            if (covered) {
                EXPECT_EQ(audit.missed, 0u);
            }
            missed += audit.missed;
        }
    }
    EXPECT_GT(missed, 100u);
}

TYPED_TEST(MissedPairsIn, TheLawContinuousMissesNone) {
    using Real = TypeParam;
    for (const PartitionerConfig& partitioner :
         {PartitionerConfig(StaticGrid{{9, 14}}), PartitionerConfig(Quadtree{7, 3}),
          PartitionerConfig(SemiStaticQuadtree{7, 3})}) {
        SimulationConfig config = counting(partitioner, precisionOf<Real>);
        config.law = Law::Continuous;
        Simulation sim(this->scene(1), config);
        std::uint64_t overlapping = 0;
        for (int i = 0; i < 30; ++i) {
            const StepReport report = sim.step();
            ASSERT_EQ(report.missedPairs, 0u);
            overlapping += report.overlappingPairs;
        }
        EXPECT_GT(overlapping, 100u);
    }
}

TYPED_TEST(MissedPairsIn, PairsThatShareSeveralStaleCellsAreResolvedOnce) {
    using Real = TypeParam;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        // Boxes of up to 16 px in cells of 2: almost every pair shares several.
        Simulation sim(this->scene(seed),
                       counting(SemiStaticQuadtree{7, 1, EveryFrames{5}}, precisionOf<Real>));
        PairList seen;
        sim.onContact([&](const Contact& c) {
            seen.emplace_back(static_cast<std::uint32_t>(c.numberA),
                              static_cast<std::uint32_t>(c.numberB));
        });
        run<Real>(sim, 20, [&](const Boxes<Real>&, const StepReport& report) {
            ASSERT_EQ(seen.size(), report.contacts);
            std::sort(seen.begin(), seen.end());
            ASSERT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
            seen.clear();
        });
    }
}

TYPED_TEST(MissedPairsIn, ATreeThatIsRebuiltEachFrameGivesTheAnswerOfACompleteOne) {
    using Real = TypeParam;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Simulation stale(this->scene(seed),
                         counting(SemiStaticQuadtree{7, 2, EveryFrames{1}}, precisionOf<Real>));
        Simulation complete(this->scene(seed), counting(Quadtree{7, 2}, precisionOf<Real>));
        stale.run(40);
        complete.run(40);
        EXPECT_EQ(stateHash(stale.world()), stateHash(complete.world()));
    }
}

}  // namespace
}  // namespace quadrille
