#include <gtest/gtest.h>
#include <iostream>
#include <string>
#include <tuple>

#include <quadrille/names.hpp>

#include "statistics/checks.hpp"

// The long sizes of the statistics, on request: docs/accuracy.md says how.

namespace quadrille::accuracy {
namespace {

TEST(LongStatistics, ContinuousInAThinGas) {
    expectExactStatistics(thin, {.filling = thin.filling, .dt = 1}, {2000, 250'000}, 1e-12);
}

TEST(LongStatistics, ContinuousInAMiddlingGas) {
    expectExactStatistics(middling, {.filling = middling.filling, .dt = 1.0 / 8}, {200, 30'000},
                          1e-12);
}

TEST(LongStatistics, ContinuousInAThickGas) {
    expectExactStatistics(thick, {.filling = thick.filling}, {50, 3000}, 1e-12);
}

// The reference's Z = 19.469(1) is that of 1,024 squares without walls; between walls n / (n + 1)
// of Z - 1 remain (hard_cases/crowds.cpp).
TEST(LongStatistics, ContinuousJammed) {
    constexpr double z = 1 + 18.469 * 32 / 33;
    expectExactStatistics({0.9, z, 1e-3}, {.filling = 0.9}, {20, 200}, 1e-12);
}

TEST(LongStatistics, BiasOfImpulse) {
    struct Step {
        double dt, bias, identity;
    };
    for (const Step& step :
         {Step{1.0 / 60, -0.006, 2e-3}, Step{1.0 / 240, 0, 2e-4}, Step{1.0 / 960, 0, 2e-5}}) {
        const Bias bias = measureBias(
            thick, {.filling = thick.filling, .law = Law::Impulse, .dt = step.dt}, {10, 1800});
        std::cout << "  rate off by " << 100 * bias.rate.mean << " +- " << 100 * bias.rate.error
                  << " %\n";
        EXPECT_NEAR(bias.rate.mean, step.bias, 4 * bias.rate.error);
        EXPECT_LT(bias.identity, step.identity);
    }
}

class LongSpeeds : public testing::TestWithParam<std::tuple<Law, Precision>> {};

TEST_P(LongSpeeds, KeepTheirBits) {
    const auto [law, precision] = GetParam();
    expectSpeedsKeepTheirBits(law, precision, 50'000, 100'000);
}

INSTANTIATE_TEST_SUITE_P(All, LongSpeeds,
                         testing::Combine(testing::Values(Law::Impulse, Law::Continuous),
                                          testing::Values(Precision::Double, Precision::Float)),
                         [](const auto& test) {
                             return std::string(name(std::get<0>(test.param))) + "_" +
                                    std::string(name(std::get<1>(test.param)));
                         });

}  // namespace
}  // namespace quadrille::accuracy
