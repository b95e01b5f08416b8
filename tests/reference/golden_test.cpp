#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <vector>

#include "reference/lattice_oracle.hpp"
#include "reference/oracle.hpp"
#include "support.hpp"

// The golden runs of accuracy.md, section 1: computed elsewhere, in exact rational arithmetic.
namespace quadrille::reference {
namespace {

class GoldenRun : public testing::TestWithParam<Golden> {};
INSTANTIATE_TEST_SUITE_P(Reference, GoldenRun, testing::Values(small64, a1700, dense1600),
                         [](const auto& instance) { return instance.param.name; });

/// The largest difference of a coordinate or a velocity component from a golden state.
double largestError(const std::vector<Box>& state, const std::string& file) {
    const auto rows = readCsv(file);
    const auto moving = movingOf(state);
    EXPECT_EQ(moving.size(), rows.size());
    double largest = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Vec2 x = moving[i].position - Vec2(rows[i][1], rows[i][2]);
        const Vec2 v = moving[i].velocity - Vec2(rows[i][3], rows[i][4]);
        largest = std::max({largest, x.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff()});
    }
    return largest;
}

/// Whether the collisions are the golden ones, in their order; the largest difference in time.
double largestTimeError(const std::vector<Event>& events, const std::string& file) {
    const auto rows = readCsv(file);
    EXPECT_EQ(events.size(), rows.size());
    double largest = 0;
    for (std::size_t k = 0; k < std::min(events.size(), rows.size()); ++k) {
        const Event& event = events[k];
        const bool same = event.i == std::int64_t(rows[k][1]) &&
                          event.j == std::int64_t(rows[k][2]) && event.axis == int(rows[k][3]);
        EXPECT_TRUE(same) << "collision " << k;
        if (!same) break;
        largest = std::max(largest, std::abs(event.time - rows[k][0]));
    }
    return largest;
}

TEST_P(GoldenRun, IsReproducedToTheLastBit) {
    LatticeOracle oracle(boxesOf(GetParam()));
    for (const auto& [label, time] : GetParam().states) {
        oracle.runUntil(time);
        EXPECT_EQ(largestError(oracle.state(), GetParam().name + "_t" + label + ".csv"), 0)
            << label;
    }
    EXPECT_EQ(largestTimeError(oracle.events(), GetParam().name + "_events.csv"), 0);
}

TEST_P(GoldenRun, IsReproducedInDoublePrecision) {
    Oracle oracle(boxesOf(GetParam()));
    for (const auto& [label, time] : GetParam().states) {
        oracle.runUntil(time);
        EXPECT_LE(largestError(oracle.state(), GetParam().name + "_t" + label + ".csv"), 1e-9)
            << label;
    }
    EXPECT_LE(largestTimeError(oracle.events(), GetParam().name + "_events.csv"), 1e-9);
}

}  // namespace
}  // namespace quadrille::reference
