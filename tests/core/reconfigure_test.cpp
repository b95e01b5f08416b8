#include <gtest/gtest.h>
#include <utility>

#include <quadrille/quadrille.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

constexpr Precision precisions[] = {Precision::Double, Precision::Float};

SimulationConfig configOf(Law law, Precision precision = Precision::Double) {
    return {.partitioner = Quadtree{}, .law = law, .precision = precision};
}

/// A simulation of the same state at the same time that knows nothing of the past.
Simulation restarted(const Simulation& simulation, const SimulationConfig& config) {
    const World& from = simulation.world();
    World world(from.config());
    from.visitBodies([&](const auto& bodies) {
        const auto& f = bodies.fixed;
        for (std::size_t i = 0; i < f.size(); ++i) {
            makeBody(world, {f.x[i], f.y[i]}, {.isStatic = true},
                     {2 * double(f.halfWidth[i]), 2 * double(f.halfHeight[i])});
        }
        const auto& m = bodies.moving;
        for (std::size_t i = 0; i < m.size(); ++i) {
            makeBody(world, {m.x[i], m.y[i]},
                     {.velocity = {m.vx[i], m.vy[i]}, .mass = double(m.mass[i])},
                     {2 * double(m.halfWidth[i]), 2 * double(m.halfHeight[i])});
        }
    });
    Simulation result(std::move(world), config);
    result.resumeAt(simulation.stepsDone());
    return result;
}

/// Where the law was something else before must not show: anchors of `continuous` that the discrete
/// laws left behind would put bodies back on paths that they left long ago.
TEST(Reconfigure, ALawThatIsSwitchedToGoesOnFromThePresentState) {
    for (const Precision precision : precisions) {
        SCOPED_TRACE(name(precision));
        Simulation sim(crowd(7), configOf(Law::Impulse, precision));
        for (const Law law : {Law::Continuous, Law::Impulse, Law::Continuous, Law::Baseline,
                              Law::Continuous, Law::Impulse}) {
            SCOPED_TRACE(name(law));
            const auto before = stateHash(sim.world());
            sim.reconfigure(configOf(law, precision));
            EXPECT_EQ(sim.config().law, law);
            EXPECT_EQ(stateHash(sim.world()), before);
            Simulation fresh = restarted(sim, configOf(law, precision));
            for (int i = 0; i < 15; ++i) {
                sim.step();
                fresh.step();
                ASSERT_EQ(stateHash(sim.world()), stateHash(fresh.world())) << "step " << i;
            }
            EXPECT_DOUBLE_EQ(sim.time(), fresh.time());
        }
    }
}

TEST(Reconfigure, ContinuousKeepsItsPathWhenThePartitionerChanges) {
    for (const Precision precision : precisions) {
        SCOPED_TRACE(name(precision));
        const PartitionerConfig partitioners[] = {BruteForce{}, StaticGrid{{9, 14}}, Quadtree{6, 4},
                                                  SemiStaticQuadtree{6, 4}};
        Simulation reference(crowd(11), configOf(Law::Continuous, precision));
        Simulation switching(crowd(11), configOf(Law::Continuous, precision));
        for (int i = 0; i < 40; ++i) {
            if (i % 3 == 0) switching.setPartitioner(partitioners[i / 3 % 4]);
            reference.step();
            switching.step();
            ASSERT_EQ(stateHash(switching.world()), stateHash(reference.world())) << "step " << i;
        }
    }
}

TEST(Reconfigure, ASnapshotThatIsLoadedWithAnotherLawForgetsItsAnchors) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "snapshot";
    Simulation sim(crowd(8), configOf(Law::Continuous));
    sim.run(10);
    saveSnapshot(file, sim, "crowd", 8);
    Snapshot snapshot = loadSnapshot(file);
    Simulation discrete(std::move(snapshot.world), configOf(Law::Impulse));
    discrete.resumeAt(snapshot.stepsDone);
    discrete.run(10);
    Simulation fresh = restarted(discrete, configOf(Law::Continuous));
    discrete.reconfigure(configOf(Law::Continuous));
    discrete.run(10);
    fresh.run(10);
    EXPECT_EQ(stateHash(discrete.world()), stateHash(fresh.world()));
}

TEST(Reconfigure, ChangesGravityRestitutionAndWhatIsMeasured) {
    Simulation sim(crowd(9), configOf(Law::Impulse));
    sim.run(5);
    SimulationConfig next = sim.config();
    next.step.gravity = {0, -50};
    next.step.restitution = 0.5;
    next.profile = true;
    next.countMissedPairs = true;
    next.partitioner = SemiStaticQuadtree{.rebuild = SemiStaticQuadtree::EveryFrames{1000}};
    sim.reconfigure(next);
    const double before = kineticEnergy(sim.world());
    std::uint64_t missed = 0;
    double seconds = 0;
    for (int i = 0; i < 60; ++i) {
        const StepReport& report = sim.step();
        missed += report.missedPairs;
        for (const double phase : report.phaseSeconds) seconds += phase;
    }
    EXPECT_GT(missed, 0u);
    EXPECT_GT(seconds, 0);
    EXPECT_LT(kineticEnergy(sim.world()), before);
}

TEST(Reconfigure, RefusesWhatCannotChangeOrRunAndKeepsTheOld) {
    Simulation reference(crowd(10), configOf(Law::Continuous));
    Simulation sim(crowd(10), configOf(Law::Continuous));
    reference.run(8);
    sim.run(3);
    const auto refuse = [&](auto&& change) {
        SimulationConfig next = sim.config();
        change(next);
        EXPECT_THROW(sim.reconfigure(next), Error);
    };
    refuse([](auto& c) { c.step.dt *= 2; });
    refuse([](auto& c) { c.precision = Precision::Float; });
    refuse([](auto& c) { c.step.restitution = 2; });
    refuse([](auto& c) { c.step.gravity.x() = nan; });
    refuse([](auto& c) { c.partitioner = StaticGrid{{-1, 1}}; });
    refuse([](auto& c) {
        c.partitioner = SemiStaticQuadtree{.rebuild = SemiStaticQuadtree::EveryFrames{10}};
    });
    EXPECT_EQ(sim.config().law, Law::Continuous);
    EXPECT_EQ(name(sim.config().partitioner), "quadtree");
    sim.run(5);
    EXPECT_EQ(stateHash(sim.world()), stateHash(reference.world()));
}

}  // namespace
}  // namespace quadrille
