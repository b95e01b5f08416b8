#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

#include <quadrille/partitioner_config.hpp>

#include "collision/broad/partitioner.hpp"
#include "collision/support.hpp"
#include "partition_checks.hpp"

namespace quadrille {
namespace {

using Members = std::vector<BodyRef>;

BodyRef moves(std::uint32_t row) { return BodyRef::moving(row); }
BodyRef stands(std::uint32_t row) { return BodyRef::fixed(row); }

Members membersOf(const Cells& cells, std::size_t cell) {
    const auto members = cells[cell];
    return {members.begin(), members.end()};
}

/// The cells of a world of 64 x 32 px.
Cells cellsOf(World& world, const PartitionerConfig& config) {
    const auto partitioner = makePartitioner<double>(config, world.config().size);
    update(*partitioner, world.bodies<double>());
    return partitioner->partition().cells;
}

World emptyWorld() { return World({.size = {64, 32}}); }

TEST(Cells, OfAGridRunRowByRowFromTheLowCorner) {
    World world = emptyWorld();
    const Cells cells = cellsOf(world, StaticGrid{{16, 16}});
    ASSERT_EQ(cells.size(), 8u);
    EXPECT_EQ(cells.bounds(0).low, Vec2(-32, -16));
    EXPECT_EQ(cells.bounds(0).high, Vec2(-16, 0));
    EXPECT_EQ(cells.bounds(5).low, Vec2(-16, 0));
    EXPECT_EQ(cells.bounds(7).high, Vec2(32, 16));
}

TEST(Cells, OfAGridThatDoesNotDivideTheWorldCoverIt) {
    World world = emptyWorld();
    const Cells cells = cellsOf(world, StaticGrid{{30, 50}});
    ASSERT_EQ(cells.size(), 3u);
    EXPECT_EQ(cells.bounds(2).low, Vec2(28, -16));
}

TEST(Cells, OfATreeBeginWithTheWorld) {
    World world = emptyWorld();
    const Cells cells = cellsOf(world, Quadtree{});
    ASSERT_EQ(cells.size(), 1u);
    EXPECT_EQ(cells.bounds(0).low, Vec2(-32, -16));
    EXPECT_EQ(cells.bounds(0).high, Vec2(32, 16));
    EXPECT_TRUE(cells[0].empty());
}

TEST(Cells, HoldMovingBodiesFirstAndStaticOnesAfterThem) {
    World world = emptyWorld();
    makeBox(world, {-24, -8}, fixed());  // static 0
    makeBox(world, {-24, -8});           // moving 0
    makeBox(world, {8, 8});              // moving 1
    makeBox(world, {-20, -4});           // moving 2
    const Cells cells = cellsOf(world, StaticGrid{{16, 16}});
    EXPECT_EQ(membersOf(cells, 0), Members({moves(0), moves(2), stands(0)}));
    EXPECT_EQ(membersOf(cells, 6), Members({moves(1)}));
    EXPECT_EQ(cells.bodies.size(), 4u);
}

TEST(Cells, ABodyOnABorderStandsOnBothSides) {
    World world = emptyWorld();
    makeBox(world, {0, 8});
    makeBox(world, {0, 0});
    const Cells cells = cellsOf(world, StaticGrid{{16, 16}});
    EXPECT_EQ(membersOf(cells, 1), Members({moves(1)}));
    EXPECT_EQ(membersOf(cells, 2), Members({moves(1)}));
    EXPECT_EQ(membersOf(cells, 5), Members({moves(0), moves(1)}));
    EXPECT_EQ(membersOf(cells, 6), Members({moves(0), moves(1)}));
}

TEST(Cells, BorderCellsReachToInfinity) {
    World world = emptyWorld();
    makeBox(world, {-1e9, -1e9});
    makeBox(world, {1e9, 0.5}, {}, {2, 0.5});
    makeBox(world, {24, 1e300});
    const Cells cells = cellsOf(world, StaticGrid{{16, 16}});
    EXPECT_EQ(membersOf(cells, 0), Members({moves(0)}));
    EXPECT_EQ(membersOf(cells, 7), Members({moves(1), moves(2)}));
    EXPECT_EQ(cells.bodies.size(), 3u);
}

TEST(Cells, ALeafSplitsWhenItHoldsMoreThanItMay) {
    World world = emptyWorld();
    for (const double x : {-24.0, -20.0, 8.0}) makeBox(world, {x, -8});
    EXPECT_EQ(cellsOf(world, Quadtree{5, 3}).size(), 1u);
    // The first split leaves two bodies in the low left leaf, one in the low right one.
    const Cells two = cellsOf(world, Quadtree{5, 2});
    ASSERT_EQ(two.size(), 4u);
    EXPECT_EQ(membersOf(two, 0), Members({moves(0), moves(1)}));
    EXPECT_EQ(membersOf(two, 1), Members({moves(2)}));
    EXPECT_EQ(two.bounds(1).low, Vec2(0, -16));
    EXPECT_EQ(two.bounds(2).low, Vec2(-32, 0));
    EXPECT_EQ(cellsOf(world, Quadtree{0, 1}).size(), 1u);
}

TEST(Cells, ALeafThatAllItsBodiesCoverDoesNotSplit) {
    World world = emptyWorld();
    for (int i = 0; i < 10; ++i) makeBox(world, {0, 0}, {}, {1000, 1000});
    const Cells cells = cellsOf(world, Quadtree{15, 1});
    ASSERT_EQ(cells.size(), 1u);
    EXPECT_EQ(cells[0].size(), 10u);
}

TEST(Cells, LoadSumsThemUp) {
    World world = emptyWorld();
    for (const double x : {-24.0, -24.0, -20.0, 8.0}) makeBox(world, {x, -8});
    const CellLoad full = loadOf(cellsOf(world, StaticGrid{{16, 16}}));
    EXPECT_EQ(full.cells, 8u);
    EXPECT_EQ(full.activeCells, 2u);
    EXPECT_EQ(full.maxBodies, 3u);
    EXPECT_EQ(full.meanBodies, 2);

    const CellLoad none = loadOf(Cells{});
    EXPECT_EQ(none.cells, 0u);
    EXPECT_EQ(none.meanBodies, 0);
}

TEST(Cells, OfASimulationAreThoseOfItsLastStep) {
    World world = emptyWorld();
    makeBox(world, {-24, -8}, moving(64));
    Simulation sim(std::move(world), {.partitioner = StaticGrid{{16, 16}}, .step = {.dt = 0.25}});
    sim.step();
    EXPECT_EQ(membersOf(sim.cells(), 1), Members({moves(0)}));
    sim.setPartitioner(StaticGrid{{64, 32}});
    sim.step();
    EXPECT_EQ(sim.cells().size(), 1u);
}

}  // namespace
}  // namespace quadrille
