#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <tuple>

#include <quadrille/names.hpp>

#include "hard_cases/hard_case.hpp"

// Every hard case with every law in both precisions: either the exact outcome, or what is known to
// come out instead.

namespace quadrille::accuracy {

void PrintTo(const HardCase& c, std::ostream* out) { *out << c.title; }

namespace {

class HardCases : public testing::TestWithParam<std::tuple<HardCase, Law, Precision>> {};

TEST_P(HardCases, EndAsTheTableSays) {
    const auto& [hardCase, law, precision] = GetParam();
    const Outcome outcome = [&] {
        try {
            return hardCase.run({law, precision});
        } catch (const Error& error) {
            return Outcome{"refused", error.what()};
        }
    }();
    EXPECT_EQ(outcome.text, hardCase.expected(law).of(precision)) << outcome.detail;
}

std::string nameOf(const testing::TestParamInfo<HardCases::ParamType>& info) {
    const auto& [hardCase, law, precision] = info.param;
    return hardCase.name + "_" + std::string(name(law)) + "_" + std::string(name(precision));
}

INSTANTIATE_TEST_SUITE_P(Accuracy, HardCases,
                         testing::Combine(testing::ValuesIn(hardCases()),
                                          testing::Values(Law::Baseline, Law::Impulse,
                                                          Law::Continuous),
                                          testing::Values(Precision::Double, Precision::Float)),
                         nameOf);

}  // namespace
}  // namespace quadrille::accuracy
