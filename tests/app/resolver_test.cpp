#include <gtest/gtest.h>
#include <string>

#include "program.hpp"

namespace quadrille {
namespace {

const Arguments cradle = {"--headless", "--scene", "cradle", "--frames", "5"};

class Fallback : public testing::TestWithParam<std::string> {};

/// Where the resolver exists there is nothing to fall back from.
bool available(const std::string& resolver) {
    return runProgram(cradle + Arguments{"--resolver", resolver, "--no-fallback"}).exitCode == 0;
}

TEST_P(Fallback, IsNamedInEveryOutput) {
    if (available(GetParam())) GTEST_SKIP() << GetParam() << " runs here";
    const Arguments run = cradle + Arguments{"--resolver", GetParam()};

    const ProcessResult words = runProgram(run);
    EXPECT_EQ(words.exitCode, 0);
    EXPECT_TRUE(contains(words.err, "warning")) << words.err;
    EXPECT_TRUE(contains(words.err, "'" + GetParam() + "'")) << words.err;
    EXPECT_TRUE(contains(words.err, "'sequential'")) << words.err;
    EXPECT_TRUE(contains(words.out, "resolver sequential (asked for: " + GetParam() + ")"))
        << words.out;

    const ProcessResult data = runProgram(run + Arguments{"--json", "-"});
    EXPECT_EQ(data.exitCode, 0);
    EXPECT_TRUE(contains(data.err, "warning")) << data.err;
    const Json summary = Json::parse(data.out);
    EXPECT_EQ(summary["resolver"], "sequential");
    EXPECT_EQ(summary["requested_resolver"], GetParam());
}

INSTANTIATE_TEST_SUITE_P(Resolver, Fallback, testing::Values("cuda", "cuda-resident", "threads"),
                         [](const auto& test) { return identifier(test.param); });

class NoDevice : public testing::TestWithParam<std::string> {};

TEST_P(NoDevice, IsAnErrorWithoutFallback) {
    if (available(GetParam())) GTEST_SKIP() << GetParam() << " runs here";
    expectRefusal(cradle + Arguments{"--resolver", GetParam(), "--no-fallback"}, 4, {GetParam()});
}

INSTANTIATE_TEST_SUITE_P(Resolver, NoDevice, testing::Values("cuda", "cuda-resident"),
                         [](const auto& test) { return identifier(test.param); });

TEST(Resolver, AutoNeedsNoFallback) {
    const ProcessResult result = runProgram(cradle + Arguments{"--no-fallback"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
}

TEST(Resolver, SequentialIsWhatRuns) {
    const ProcessResult result =
        runProgram(cradle + Arguments{"--resolver", "sequential", "--no-fallback", "--json", "-"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_FALSE(contains(result.err, "warning")) << result.err;
    const Json summary = Json::parse(result.out);
    EXPECT_EQ(summary["resolver"], "sequential");
    EXPECT_EQ(summary["requested_resolver"], "sequential");
    EXPECT_EQ(summary["threads"], 1);
    EXPECT_TRUE(summary["device"].is_null());
}

}  // namespace
}  // namespace quadrille
