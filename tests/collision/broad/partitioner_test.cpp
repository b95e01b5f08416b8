#include "collision/broad/partitioner.hpp"

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <quadrille/error.hpp>
#include <quadrille/names.hpp>
#include <quadrille/partitioner_config.hpp>

#include "collision/pairs/narrow_phase.hpp"
#include "collision/random_scene.hpp"
#include "collision/support.hpp"
#include "partition_checks.hpp"
#include "reals.hpp"
#include "sanitized.hpp"

namespace quadrille {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Skin = SemiStaticQuadtree::Skin;
using EveryFrames = SemiStaticQuadtree::EveryFrames;

std::string text(const Vec2& v) { return std::to_string(v.x()) + " x " + std::to_string(v.y()); }

template <class Real>
class PartitionerTest : public testing::Test {
  protected:
    /// Compares what the narrow phase finds through the partition with all against all, for each
    /// kind of scene; `most` bodies in a scene.
    void expectCompleteAndWellFormed(const PartitionerConfig& config, std::uint64_t cases,
                                     int most) {
        for (const SceneKind kind : sceneKinds) {
            const std::uint64_t first = 1000 * cases;
            for (std::uint64_t seed = first; seed < first + scenesOf(cases); ++seed) {
                SCOPED_TRACE(std::string(name(kind)) + ", seed " + std::to_string(seed) +
                             ", bodies " + std::to_string(most));
                World world = randomScene(kind, seed, most);
                world.setPrecision(precisionOf<Real>);
                const auto bodies = world.template bodies<Real>();
                const auto partitioner = makePartitioner<Real>(config, world.config().size);
                EXPECT_TRUE(update(*partitioner, bodies));
                const auto& partition = partitioner->partition();
                NarrowPhase<Real> narrowPhase;
                ASSERT_EQ(difference(foundPairs(narrowPhase, bodies, partition),
                                     overlappingPairs(Boxes<Real>(bodies))),
                          "");
                ASSERT_EQ(faultOfCells(bodies, partition), "");
                if (const auto* tree = std::get_if<Quadtree>(&config)) {
                    ASSERT_EQ(faultOfTree(bodies, partition, tree->maxDepth, tree->maxPerCell), "");
                }
                if (const auto* tree = std::get_if<SemiStaticQuadtree>(&config)) {
                    ASSERT_EQ(faultOfTree(bodies, partition, tree->maxDepth, tree->maxPerCell), "");
                }
            }
        }
    }
};

TYPED_TEST_SUITE(PartitionerTest, Reals, RealNames);

TYPED_TEST(PartitionerTest, BruteForceIsCompleteAndUnique) {
    this->expectCompleteAndWellFormed(BruteForce{}, 12, 120);
}

TYPED_TEST(PartitionerTest, StaticGridIsCompleteAndUnique) {
    for (const Vec2& cell : {Vec2(26, 26), Vec2(8, 8), Vec2(13, 26), Vec2(5, 40), Vec2(1000, 3),
                             Vec2(1.7, 2.9), Vec2(1e4, 1e4), Vec2(1e300, 1e-1)}) {
        SCOPED_TRACE("cell " + text(cell));
        this->expectCompleteAndWellFormed(StaticGrid{cell}, 15, cell.minCoeff() < 3 ? 40 : 120);
    }
}

TYPED_TEST(PartitionerTest, QuadtreeIsCompleteAndUnique) {
    for (const int depth : {0, 1, 5, 10, 15}) {
        for (const int most : {1, 4, 20, 1000}) {
            SCOPED_TRACE("depth " + std::to_string(depth) + ", per cell " + std::to_string(most));
            // Deep trees cut the edges of large boxes into very many cells.
            const bool large = most < 20 && depth >= 10;
            const std::uint64_t cases = !large ? 10 : depth == 10 ? 5 : 2;
            const int bodies = depth < 10 ? 100 : !large ? 50 : depth == 10 ? 16 : 5;
            this->expectCompleteAndWellFormed(Quadtree{depth, most}, cases, bodies);
        }
    }
}

TYPED_TEST(PartitionerTest, SemiStaticQuadtreeIsCompleteAndUniqueWhenBuilt) {
    for (const double width : {0.0, 1e-30, 1e-4, 0.3, 5.0, 70.0, 1e6}) {
        SCOPED_TRACE("skin " + std::to_string(width));
        const int bodies = width == 70 ? 30 : 80;
        this->expectCompleteAndWellFormed(SemiStaticQuadtree{8, 20, Skin{width}}, 8, bodies);
        this->expectCompleteAndWellFormed(SemiStaticQuadtree{6, 3, Skin{width}}, 8, bodies);
    }
}

TYPED_TEST(PartitionerTest, KeepsNothingOfThePreviousScene) {
    // One partitioner and one narrow phase see scene after scene, as in a simulation whose bodies
    // are created and destroyed.
    using Real = TypeParam;
    const std::vector<PartitionerConfig> configs = {BruteForce{}, StaticGrid{{11, 7}},
                                                    Quadtree{8, 4}, SemiStaticQuadtree{8, 4},
                                                    SemiStaticQuadtree{8, 4, Skin{3}}};
    for (const PartitionerConfig& config : configs) {
        SCOPED_TRACE(name(config));
        const auto partitioner = makePartitioner<Real>(config, Vec2(256, 128));
        NarrowPhase<Real> narrowPhase;
        for (std::uint64_t seed = 0; seed < scenesOf(60); ++seed) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            World world = randomScene(sceneKinds[seed % sceneKinds.size()], seed, 60);
            world.setPrecision(precisionOf<Real>);
            auto bodies = world.template bodies<Real>();
            bodies.revision = seed + 1;
            update(*partitioner, bodies);
            ASSERT_EQ(difference(foundPairs(narrowPhase, bodies, partitioner->partition()),
                                 overlappingPairs(Boxes<Real>(bodies))),
                      "");
            ASSERT_EQ(faultOfCells(bodies, partitioner->partition()), "");
        }
    }
}

TYPED_TEST(PartitionerTest, BoxesAnUlpApartAreJudgedAsTheNarrowPhaseJudges) {
    // Edges within a few units of the last place of each other and of cell borders, where rounding
    // of centre +- half extent may put the boxes of an overlapping pair into different cells.
    using Real = TypeParam;
    const std::vector<PartitionerConfig> configs = {StaticGrid{{8, 8}}, StaticGrid{{7.3, 0.9}},
                                                    Quadtree{15, 1}, Quadtree{10, 2}};
    for (const PartitionerConfig& config : configs) {
        SCOPED_TRACE(name(config));
        for (std::uint64_t seed = 0; seed < scenesOf(400); ++seed) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            Random random(seed);
            World world({.size = {256, 128}});
            world.setPrecision(precisionOf<Real>);
            const auto ulps = [&](double value) {
                auto moved = static_cast<Real>(value);
                const auto towards = static_cast<Real>(random.sign() * inf);
                for (auto n = random.integer(0, 3); n > 0; --n) {
                    moved = std::nextafter(moved, towards);
                }
                return static_cast<double>(moved);
            };
            // Neighbours left and right of vertical borders, of sizes of many magnitudes.
            for (int i = 0; i < 8; ++i) {
                const double border = config.index() == 1 && seed % 2 == 0
                                          ? -128 + 7.3 * double(random.integer(0, 30))
                                          : 8 * double(random.integer(-15, 15));
                const double left = random.uniform(0.01, 20);
                const double right = random.uniform(0.01, 20);
                const double y = random.uniform(-60, 60);
                makeBox(world, {ulps(border - left / 2), y}, {}, {left, 0.5});
                makeBox(world, {ulps(border + right / 2), y}, {}, {right, 0.5});
            }
            const auto bodies = world.template bodies<Real>();
            const auto partitioner = makePartitioner<Real>(config, world.config().size);
            update(*partitioner, bodies);
            NarrowPhase<Real> narrowPhase;
            ASSERT_EQ(difference(foundPairs(narrowPhase, bodies, partitioner->partition()),
                                 overlappingPairs(Boxes<Real>(bodies))),
                      "");
        }
    }
}

// ---- parameters

template <class Real = double>
std::string errorOf(const PartitionerConfig& config, const Vec2& world = {256, 128}) {
    try {
        makePartitioner<Real>(config, world);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(PartitionerParameters, BadOnesAreNamed) {
    const auto expectNamed = [](const PartitionerConfig& config, const std::string& parameter) {
        EXPECT_NE(errorOf<double>(config).find(parameter), std::string::npos)
            << errorOf<double>(config);
        EXPECT_EQ(errorOf<double>(config), errorOf<float>(config));
    };
    for (const double bad : {0.0, -1.0, inf, -inf, nan}) {
        SCOPED_TRACE(bad);
        expectNamed(StaticGrid{{bad, 26}}, "cell size");
        expectNamed(StaticGrid{{26, bad}}, "cell size");
    }
    expectNamed(StaticGrid{{1e-3, 26}}, "cell size");  // 256,000 cells along x
    expectNamed(StaticGrid{{26, 1e-300}}, "cell size");
    expectNamed(StaticGrid{{0.004, 0.002}}, "cell size");  // 64,000 x 64,000 cells
    for (const int depth :
         {-1, 16, 1000, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()}) {
        SCOPED_TRACE(depth);
        expectNamed(Quadtree{depth, 20}, "depth");
        expectNamed(SemiStaticQuadtree{depth, 20}, "depth");
    }
    for (const int most : {0, -1, std::numeric_limits<int>::min()}) {
        SCOPED_TRACE(most);
        expectNamed(Quadtree{10, most}, "a cell must be allowed at least one body");
        expectNamed(SemiStaticQuadtree{10, most}, "a cell must be allowed at least one body");
    }
    for (const double bad : {-1e-9, -1.0, inf, -inf, nan}) {
        SCOPED_TRACE(bad);
        expectNamed(SemiStaticQuadtree{10, 20, Skin{bad}}, "skin");
    }
    for (const int frames : {0, -1, std::numeric_limits<int>::min()}) {
        SCOPED_TRACE(frames);
        expectNamed(SemiStaticQuadtree{10, 20, EveryFrames{frames}}, "rebuild");
    }
}

TEST(PartitionerParameters, GoodOnesAreTaken) {
    const std::vector<PartitionerConfig> configs = {BruteForce{},
                                                    StaticGrid{{1e-2, 128}},
                                                    StaticGrid{{1e308, 1e308}},
                                                    Quadtree{0, 1},
                                                    Quadtree{15, std::numeric_limits<int>::max()},
                                                    SemiStaticQuadtree{0, 1, Skin{1e30}},
                                                    SemiStaticQuadtree{15, 1, EveryFrames{1}}};
    for (const PartitionerConfig& config : configs) {
        EXPECT_EQ(errorOf<double>(config), "no error");
        EXPECT_EQ(errorOf<float>(config), "no error");
    }
}

TEST(PartitionerParameters, ASimulationRefusesThemAndKeepsItsOwn) {
    Simulation sim(World{}, {.partitioner = Quadtree{5, 7}});
    EXPECT_THROW(sim.setPartitioner(Quadtree{16, 1}), Error);
    EXPECT_EQ(std::get<Quadtree>(sim.config().partitioner).maxDepth, 5);
    sim.run(2);
    EXPECT_THROW(Simulation(World{}, {.partitioner = StaticGrid{{0, 1}}}), Error);
}

}  // namespace
}  // namespace quadrille
