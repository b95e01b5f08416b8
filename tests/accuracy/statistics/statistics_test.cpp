#include <gtest/gtest.h>

#include "statistics/checks.hpp"

// The short sizes; long_test.cpp has the long ones.

namespace quadrille::accuracy {
namespace {

// The continuous law does not depend on dt, so its thin gas may take long steps.
TEST(Statistics, ContinuousInAThinGas) {
    expectExactStatistics(thin, {.filling = thin.filling, .dt = 1}, {500, 2000}, 1e-12);
}

TEST(Statistics, ContinuousInAMiddlingGas) {
    expectExactStatistics(middling, {.filling = middling.filling, .dt = 1.0 / 8}, {100, 500},
                          1e-12);
}

TEST(Statistics, ContinuousInAThickGas) {
    expectExactStatistics(thick, {.filling = thick.filling}, {10, 100}, 1e-12);
}

TEST(Statistics, ContinuousInSinglePrecision) {
    expectExactStatistics(thick, {.filling = thick.filling, .precision = Precision::Float},
                          {10, 100}, 1e-5);
}

// `impulse` sees too few hits in a thick gas: where a body has two in a step, one of them may wait
// or be lost. The long sample gives 0.60 % too few.
TEST(Statistics, ImpulseHitsTooRarelyInAThickGas) {
    const Bias bias =
        measureBias(thick, {.filling = thick.filling, .law = Law::Impulse}, {10, 300});
    EXPECT_NEAR(bias.rate.mean, -0.006, 4 * bias.rate.error);
    EXPECT_LT(bias.rate.mean + 2 * bias.rate.error, 0);
    EXPECT_LT(bias.identity, 2e-3);
}

TEST(Statistics, SpeedsOfImpulseKeepTheirBits) {
    expectSpeedsKeepTheirBits(Law::Impulse, Precision::Double, 1000, 100'000);
}

TEST(Statistics, SpeedsOfImpulseKeepTheirBitsInSinglePrecision) {
    expectSpeedsKeepTheirBits(Law::Impulse, Precision::Float, 1000, 100'000);
}

TEST(Statistics, SpeedsOfContinuousKeepTheirBits) {
    expectSpeedsKeepTheirBits(Law::Continuous, Precision::Double, 1000, 100'000);
}

TEST(Statistics, SpeedsOfContinuousKeepTheirBitsInSinglePrecision) {
    expectSpeedsKeepTheirBits(Law::Continuous, Precision::Float, 1000, 100'000);
}

}  // namespace
}  // namespace quadrille::accuracy
