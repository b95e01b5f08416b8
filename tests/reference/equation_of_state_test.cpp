#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

#include "reference/oracle.hpp"
#include "support.hpp"

// The rate of pair hits of hard parallel squares: accuracy.md, section 3.
namespace quadrille::reference {
namespace {

/// The mean of |v_i - v_j| along an axis over the distinct pairs, px/s.
double meanRelativeSpeed(const std::vector<Box>& moving, int k) {
    double sum = 0;
    for (const Box& a : moving) {
        for (const Box& b : moving) sum += std::abs(a.velocity[k] - b.velocity[k]);
    }
    const double n = double(moving.size());
    return sum / (n * (n - 1));
}

TEST(EquationOfState, GivesTheRateOfPairHitsOfA1700) {
    const double horizon = 300;
    const double side = 3;
    const auto boxes = boxesOf(a1700);
    const auto moving = movingOf(boxes);
    const double n = double(moving.size());

    const double eta = n * side * side / (a1700.world.x() * a1700.world.y());
    double excess = 0;  // Z - 1
    double power = 1;
    for (const double b : {2.0, 3.0, 11.0 / 3, 67.0 / 18, 121.0 / 40, 17827.0 / 10800}) {
        power *= eta;
        excess += b * power;
    }

    Oracle oracle(boxes);
    oracle.runUntil(horizon);
    double hits[2] = {0, 0};
    for (const Event& event : oracle.events()) {
        if (event.j >= 0) hits[event.axis - 1] += 1;
    }
    for (int k = 0; k < 2; ++k) {
        // Section 3 counts a pair hit once for each of its two bodies.
        const double expected = n * horizon * excess * meanRelativeSpeed(moving, k) / side / 2;
        EXPECT_NEAR(hits[k], expected, 4 * std::sqrt(expected)) << "axis " << k;
    }
    EXPECT_NEAR(2 * (hits[0] + hits[1]) / n / horizon, 0.0344, 4 * 0.0344 / std::sqrt(8609.0));
}

}  // namespace
}  // namespace quadrille::reference
