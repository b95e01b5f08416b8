#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#include <quadrille/quadrille.hpp>

#include "reference/support.hpp"

// The law `continuous` against the golden runs (accuracy.md, section 1): recall 1, precision 1, no
// wrong body, whatever the step and the partitioner.

namespace quadrille {
namespace {

using reference::Golden;

struct Collision {
    double time;
    std::int64_t i, j;
    int axis;
};

class GoldenRun {
  public:
    GoldenRun(const Golden& golden, const SimulationConfig& config)
        : scene_(loadScene(QUADRILLE_TEST_DATA "/golden/" + golden.name + ".toml")),
          sim_(std::move(scene_.world), config) {
        sim_.onContact([this](const Contact& c) {
            collisions_.push_back({c.time, c.numberA, c.numberB, static_cast<int>(c.axis)});
        });
    }

    void runUntil(double time) {
        while (sim_.time() < time) sim_.step();
        ASSERT_EQ(sim_.time(), time);
    }

    Simulation& simulation() { return sim_; }
    const std::vector<Collision>& collisions() const { return collisions_; }

    void expectState(const std::string& file) {
        const auto rows = reference::readCsv(file);
        const auto& m = sim_.world().bodies<double>().moving;
        ASSERT_EQ(rows.size(), m.size());
        for (std::size_t i = 0; i < m.size(); ++i) {
            SCOPED_TRACE("body " + std::to_string(i));
            ASSERT_EQ(m.x[i], rows[i][1]);
            ASSERT_EQ(m.y[i], rows[i][2]);
            ASSERT_EQ(m.vx[i], rows[i][3]);
            ASSERT_EQ(m.vy[i], rows[i][4]);
        }
    }

    void expectCollisions(const std::string& file, double until) {
        std::size_t count = 0;
        for (const auto& row : reference::readCsv(file)) {
            if (row[0] > until) break;
            ASSERT_LT(count, collisions_.size());
            const Collision& c = collisions_[count++];
            SCOPED_TRACE("collision " + std::to_string(count));
            ASSERT_DOUBLE_EQ(c.time, row[0]);
            ASSERT_EQ(c.i, static_cast<std::int64_t>(row[1]));
            ASSERT_EQ(c.j, static_cast<std::int64_t>(row[2]));
            ASSERT_EQ(c.axis, static_cast<int>(row[3]));
        }
        EXPECT_EQ(count, collisions_.size()) << "collisions that the exact run does not have";
    }

  private:
    Scene scene_;
    Simulation sim_;
    std::vector<Collision> collisions_;
};

void compare(const Golden& golden, double dt, const PartitionerConfig& partitioner, double until,
             int threads = 0) {
    SCOPED_TRACE(golden.name + ", dt " + std::to_string(dt) + ", " +
                 std::string(name(partitioner)));
    GoldenRun run(golden,
                  {.partitioner = partitioner,
                   .law = Law::Continuous,
                   .resolver = threads > 0 ? ResolverKind::Threads : ResolverKind::Sequential,
                   .threads = threads,
                   .step = {.dt = dt}});
    for (const auto& state : golden.states) {
        // dense1600_t0.05 lies between two steps.
        if (state.label == "0.05" || state.time > until) continue;
        run.runUntil(state.time);
        run.expectState(golden.name + "_t" + state.label + ".csv");
        if (testing::Test::HasFatalFailure()) return;
    }
    run.expectCollisions(golden.name + "_events.csv", until);
}

TEST(ContinuousGolden, Small64AtEveryStepLength) {
    for (const double dt : {1.0 / 16, 1.0 / 60, 1.0 / 240, 1.0 / 960}) {
        compare(reference::small64, dt, SemiStaticQuadtree{}, 20);
    }
}

TEST(ContinuousGolden, Small64OnEveryPartitioner) {
    for (const PartitionerConfig& partitioner :
         {PartitionerConfig(BruteForce{}), PartitionerConfig(StaticGrid{{7, 5}}),
          PartitionerConfig(Quadtree{6, 4}),
          PartitionerConfig(SemiStaticQuadtree{6, 4, SemiStaticQuadtree::Skin{1.5}})}) {
        compare(reference::small64, 1.0 / 60, partitioner, 5);
    }
}

TEST(ContinuousGolden, A1700) {
    compare(reference::a1700, 1.0 / 16, SemiStaticQuadtree{}, 300);
    compare(reference::a1700, 1.0 / 60, SemiStaticQuadtree{}, 60);
    compare(reference::a1700, 1.0 / 60, StaticGrid{}, 10);
}

TEST(ContinuousGolden, Dense1600) {
    compare(reference::dense1600, 1.0 / 16, SemiStaticQuadtree{}, 1);
    compare(reference::dense1600, 1.0 / 60, SemiStaticQuadtree{}, 1);
    compare(reference::dense1600, 1.0 / 240, Quadtree{}, 0.25);
    compare(reference::dense1600, 1.0 / 960, StaticGrid{{5, 5}}, 0.25);
}

TEST(ContinuousGolden, OnThreads) {
    // Steps with so many events that they are split.
    for (const int threads : {2, 5}) {
        compare(reference::a1700, 1.0 / 2, SemiStaticQuadtree{}, 60, threads);
        compare(reference::dense1600, 1.0 / 16, SemiStaticQuadtree{}, 1, threads);
        compare(reference::dense1600, 1.0 / 60, StaticGrid{}, 0.25, threads);
    }
}

}  // namespace
}  // namespace quadrille
