#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"

namespace quadrille {
namespace {

class Size : public ProgramTest {};

class FewBodies : public ProgramTest, public testing::WithParamInterface<const char*> {};

TEST_P(FewBodies, OneOrNoneIsEnough) {
    for (const int count : {0, 1}) {
        const std::string state = file("state.csv");
        const Json s = summaryOf({"--entities", std::to_string(count), "--frames", "20",
                                  "--partitioner", GetParam(), "--dump-state", state, "--profile"});
        EXPECT_EQ(s["entities"], count);
        EXPECT_EQ(s["frames"], 20);
        EXPECT_EQ(s["contacts"], 0);
        EXPECT_EQ(s["escaped"], 0);
        EXPECT_EQ(s["kinetic_energy"]["relative_drift"], 0);
        EXPECT_EQ(parseTable(contentOf(state)).rows.size(), static_cast<std::size_t>(count));
    }
}

INSTANTIATE_TEST_SUITE_P(Size, FewBodies,
                         testing::Values("brute-force", "static-grid", "quadtree",
                                         "semi-static-quadtree"),
                         [](const auto& test) { return identifier(test.param); });

TEST_F(Size, TwoHundredThousandBodies) {
    const Json s =
        summaryOf({"--scene", "balanced-scaled", "--entities", "200000", "--frames", "5"});
    EXPECT_EQ(s["entities"], 200000);
    EXPECT_EQ(s["frames"], 5);
    EXPECT_EQ(s["escaped"], 0);
    EXPECT_EQ(s["kinetic_energy"]["relative_drift"], 0);
}

TEST_F(Size, TooManyBodiesAreRefused) {
    const ProcessResult result = runProgram(
        {"--headless", "--frames", "1", "--scene", "balanced-scaled", "--entities", "60000000"});
    EXPECT_TRUE(result.exitCode == 2 || result.exitCode == 3) << result.exitCode;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(contains(result.err, "at most 50000000 bodies")) << result.err;
}

}  // namespace
}  // namespace quadrille
