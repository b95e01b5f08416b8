#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <quadrille/names.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/state_hash.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

const std::vector<PartitionerConfig> partitioners = {
    BruteForce{}, StaticGrid{.cellSize = {13, 17}}, Quadtree{}, SemiStaticQuadtree{},
    SemiStaticQuadtree{.rebuild = SemiStaticQuadtree::EveryFrames{10}}};

std::string describe(const PartitionerConfig& partitioner) {
    const auto* tree = std::get_if<SemiStaticQuadtree>(&partitioner);
    const bool every =
        tree != nullptr && std::holds_alternative<SemiStaticQuadtree::EveryFrames>(tree->rebuild);
    return std::string(name(partitioner)) + (every ? " every:10" : "");
}

SimulationConfig configOf(const PartitionerConfig& partitioner = SemiStaticQuadtree{}) {
    return {.partitioner = partitioner};
}

TEST(Config, ImpossibleValuesAreRefused) {
    std::vector<SimulationConfig> bad;
    for (const double value : {0.0, -1.0, nan, infinity}) bad.push_back({.step = {.dt = value}});
    for (const double value : {nan, infinity}) {
        bad.push_back({.step = {.gravity = {value, 0}}});
        bad.push_back({.step = {.gravity = {0, value}}});
    }
    for (const double value : {-0.1, 1.1, nan}) bad.push_back({.step = {.restitution = value}});
    for (const double value : {0.0, -1.0, nan, infinity}) {
        bad.push_back({.partitioner = StaticGrid{.cellSize = {value, 1}}});
        bad.push_back({.partitioner = StaticGrid{.cellSize = {1, value}}});
    }
    for (const int depth : {-1, 16}) {
        bad.push_back({.partitioner = Quadtree{.maxDepth = depth}});
        bad.push_back({.partitioner = SemiStaticQuadtree{.maxDepth = depth}});
    }
    bad.push_back({.partitioner = Quadtree{.maxPerCell = 0}});
    bad.push_back(
        {.partitioner = SemiStaticQuadtree{.rebuild = SemiStaticQuadtree::EveryFrames{0}}});
    for (const double skin : {-1.0, nan, infinity}) {
        bad.push_back(
            {.partitioner = SemiStaticQuadtree{.rebuild = SemiStaticQuadtree::Skin{skin}}});
    }
    for (std::size_t i = 0; i < bad.size(); ++i) {
        EXPECT_THROW(Simulation(World{}, bad[i]), Error) << "configuration " << i;
    }
}

TEST(Config, ValuesThatDoNotFitFloatAreRefused) {
    for (const double value : {1e-60, 1e60}) {
        EXPECT_THROW(Simulation(World{}, {.precision = Precision::Float, .step = {.dt = value}}),
                     Error);
    }
    EXPECT_THROW(
        Simulation(World{}, {.precision = Precision::Float, .step = {.gravity = {0, -1e60}}}),
        Error);
    const SemiStaticQuadtree wide{.rebuild = SemiStaticQuadtree::Skin{1e60}};
    EXPECT_THROW(Simulation(World{}, {.partitioner = wide, .precision = Precision::Float}), Error);
    World world;
    makeBody(world, {1e60, 0});
    EXPECT_THROW(Simulation(std::move(world), {.precision = Precision::Float}), Error);
}

TEST(Config, FeaturesAreThoseOfTheScene) {
    Simulation empty(World{});
    EXPECT_FALSE(empty.features().movingBodies || empty.features().staticBodies ||
                 empty.features().gravity || empty.features().inelastic ||
                 empty.features().sizesDiffer || empty.features().massesDiffer ||
                 empty.features().listeners || empty.features().profile);
    World world;
    makeBody(world, {0, 0}, {.mass = 1}, {1, 1});
    makeBody(world, {9, 0}, {.mass = 2}, {1, 2});
    makeBody(world, {20, 0}, {.isStatic = true});
    Simulation full(std::move(world),
                    {.step = {.gravity = {0, -1}, .restitution = 0.5}, .profile = true});
    full.onContact([](const Contact&) {});
    EXPECT_TRUE(full.features().movingBodies && full.features().staticBodies &&
                full.features().gravity && full.features().inelastic &&
                full.features().sizesDiffer && full.features().massesDiffer &&
                full.features().listeners && full.features().profile);
}

// ---- partitioners

TEST(SetPartitioner, KeepsTheStateAndThePathOfHashes) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Simulation reference(crowd(seed), configOf(BruteForce{}));
        Simulation switching(crowd(seed), configOf(BruteForce{}));
        for (int i = 0; i < 40; ++i) {
            if (i % 3 == 0) {
                const auto& next = partitioners[static_cast<std::size_t>(i / 3 % 4)];
                const auto before = stateHash(switching.world());
                switching.setPartitioner(next);
                EXPECT_EQ(stateHash(switching.world()), before);
                EXPECT_EQ(switching.config().partitioner.index(), next.index());
            }
            reference.step();
            switching.step();
            ASSERT_EQ(stateHash(switching.world()), stateHash(reference.world())) << "step " << i;
        }
    }
}

TEST(SetPartitioner, RefusesImpossibleOnesAndKeepsTheOld) {
    Simulation reference(crowd(), configOf(Quadtree{}));
    Simulation sim(crowd(), configOf(Quadtree{}));
    reference.run(5);
    sim.run(2);
    EXPECT_THROW(sim.setPartitioner(StaticGrid{.cellSize = {0, 1}}), Error);
    EXPECT_EQ(name(sim.config().partitioner), "quadtree");
    sim.run(3);
    EXPECT_EQ(stateHash(sim.world()), stateHash(reference.world()));
}

TEST(Cells, AreEmptyBeforeTheFirstStepAndHoldEveryBodyAfterIt) {
    for (const auto& partitioner : partitioners) {
        SCOPED_TRACE(describe(partitioner));
        SimulationConfig config = configOf(partitioner);
        config.law = Law::Impulse;
        Simulation sim(crowd(), config);
        EXPECT_EQ(loadOf(sim.cells()).activeCells, 0u);
        sim.step();
        std::vector<bool> seen(304);
        for (const BodyRef body : sim.cells().bodies) {
            seen.at(body.isStatic() ? 300 + body.row() : body.row()) = true;
        }
        EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 304);
    }
}

// ---- positions that overflow

struct Overflow {
    PartitionerConfig partitioner;
    Precision precision;
    Law law;
};

std::vector<Overflow> overflows() {
    std::vector<Overflow> result;
    for (const auto& partitioner : partitioners) {
        for (const auto precision : {Precision::Double, Precision::Float}) {
            for (const auto law : {Law::Impulse, Law::Baseline}) {
                result.push_back({partitioner, precision, law});
            }
        }
    }
    return result;
}

TEST(Overflow, EndsInAnErrorThatNamesTheEntity) {
    for (const Overflow& o : overflows()) {
        SCOPED_TRACE(describe(o.partitioner) + ' ' + std::string(name(o.precision)) + ' ' +
                     std::string(name(o.law)));
        const double largest = o.precision == Precision::Double ? 1.7e308 : 3.4e38;
        World world;
        makeBody(world, {0, 0}, {.velocity = {1, 0}});
        const Entity fast = makeBody(world, {50, 50}, {.velocity = {0, -largest / 16}});
        Simulation sim(std::move(world), {.partitioner = o.partitioner,
                                          .law = o.law,
                                          .precision = o.precision,
                                          .step = {.dt = 1}});
        const std::string error = errorOf([&] {
            for (int i = 0; i < 100; ++i) {
                sim.step();
                const Vec2 position = sim.world().get<Transform>(fast).position;
                ASSERT_TRUE(position.allFinite()) << "after step " << sim.stepsDone();
            }
        });
        EXPECT_NE(error.find("entity 1:"), std::string::npos) << error;
    }
}

}  // namespace
}  // namespace quadrille
