#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include <quadrille/device.hpp>
#include <quadrille/simulation.hpp>

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
    const Json summary = parseJson(data.out);
    EXPECT_EQ(summary["resolver"], "sequential");
    EXPECT_EQ(summary["requested_resolver"], GetParam());
}

INSTANTIATE_TEST_SUITE_P(Resolver, Fallback, testing::Values("cuda", "cuda-resident"),
                         [](const auto& test) { return identifier(test.param); });

class NoDevice : public testing::TestWithParam<std::string> {};

TEST_P(NoDevice, IsAnErrorWithoutFallback) {
    if (available(GetParam())) GTEST_SKIP() << GetParam() << " runs here";
    expectRefusal(cradle + Arguments{"--law", "impulse", "--resolver", GetParam(), "--no-fallback"},
                  4, {"cuda"});
}

INSTANTIATE_TEST_SUITE_P(Resolver, NoDevice, testing::Values("cuda", "cuda-resident"),
                         [](const auto& test) { return identifier(test.param); });

/// The exact law runs by default, and not everywhere.
TEST(DefaultLaw, GivesWayToAPolicyThatMissesPairsWithAWarning) {
    const Arguments every = cradle + Arguments{"--rebuild", "every:3", "--json", "-"};
    const ProcessResult unnamed = runProgram(every);
    ASSERT_EQ(unnamed.exitCode, 0);
    EXPECT_EQ(parseJson(unnamed.out)["law"], "impulse");
    EXPECT_TRUE(contains(unnamed.err, "'continuous' needs a partition")) << unnamed.err;
    const ProcessResult named = runProgram(every + Arguments{"--law", "impulse"});
    EXPECT_FALSE(contains(named.err, "warning")) << named.err;
    expectRefusal(every + Arguments{"--law", "continuous"}, 2, {"misses no pair", "impulse"});
}

TEST(DefaultLaw, IsRefusedWithWhatRunsInstead) {
    expectRefusal(cradle + Arguments{"--resolver", "cuda", "--no-fallback"}, 2,
                  {"continuous", "cuda", "--law impulse"});
}

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
    const Json summary = parseJson(result.out);
    EXPECT_EQ(summary["resolver"], "sequential");
    EXPECT_EQ(summary["requested_resolver"], "sequential");
    EXPECT_EQ(summary["threads"], 1);
    EXPECT_TRUE(summary["device"].is_null());
}

// ---- threads

const Arguments pile = {"--headless", "--scene", "pile", "--frames", "30", "--json", "-"};

Json summaryOf(const Arguments& arguments) {
    const ProcessResult result = runProgram(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return parseJson(result.out);
}

TEST(Threads, EndInTheStateOfTheSequentialResolver) {
    const Json expected = summaryOf(pile + Arguments{"--resolver", "sequential"});
    for (const int threads : {1, 2, 5}) {
        const Json summary = summaryOf(
            pile + Arguments{"--resolver", "threads", "--threads", std::to_string(threads)});
        EXPECT_EQ(summary["resolver"], "threads");
        EXPECT_EQ(summary["requested_resolver"], "threads");
        EXPECT_EQ(summary["threads"], threads);
        for (const char* key : {"state_hash", "contacts", "collisions", "pairs_tested"}) {
            EXPECT_EQ(summary[key], expected[key]) << key << ", " << threads << " threads";
        }
    }
}

TEST(Threads, AreOneForEachCoreUnlessToldOtherwise) {
    const Json summary = summaryOf(pile + Arguments{"--resolver", "threads"});
    EXPECT_EQ(summary["threads"], Simulation::cores());
}

TEST(Threads, AreNamedInTheWords) {
    const ProcessResult result = runProgram({"--headless", "--scene", "pile", "--frames", "3",
                                             "--resolver", "threads", "--threads", "3"});
    EXPECT_TRUE(contains(result.out, "resolver threads (3 threads)")) << result.out;
}

TEST(Threads, RunTheLawContinuous) {
    const Arguments run = {"--headless", "--scene", "demo13k",    "--entities", "2000", "--frames",
                           "20",         "--law",   "continuous", "--json",     "-"};
    const Json expected = summaryOf(run + Arguments{"--resolver", "sequential"});
    const Json summary =
        summaryOf(run + Arguments{"--resolver", "threads", "--threads", "3", "--no-fallback"});
    EXPECT_EQ(summary["resolver"], "threads");
    EXPECT_EQ(summary["threads"], 3);
    for (const char* key : {"state_hash", "contacts", "collisions", "pairs_tested"}) {
        EXPECT_EQ(summary[key], expected[key]) << key;
    }
}

TEST(Threads, DoNotRunTheLawBaseline) {
    const Arguments run = {"--headless", "--scene",  "cradle",     "--frames", "5",
                           "--law",      "baseline", "--resolver", "threads"};
    const ProcessResult result = runProgram(run + Arguments{"--json", "-"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_TRUE(contains(result.err, "warning")) << result.err;
    EXPECT_TRUE(contains(result.err, "'baseline'")) << result.err;
    const Json summary = parseJson(result.out);
    EXPECT_EQ(summary["resolver"], "sequential");
    EXPECT_EQ(summary["requested_resolver"], "threads");
    EXPECT_EQ(summary["threads"], 1);
    expectRefusal(run + Arguments{"--no-fallback"}, 2, {"threads", "baseline"});
}

TEST(Threads, AutoTakesThemForManyBodiesOnly) {
    if (findCudaDevice().usable()) GTEST_SKIP() << "there is a device, which comes first";
    const auto resolverOf = [](const char* entities, const Arguments& more) {
        return summaryOf(Arguments{"--headless", "--scene", "balanced", "--entities", entities,
                                   "--frames", "3", "--json", "-"} +
                         more);
    };
    const Arguments four = {"--threads", "4"};
    EXPECT_EQ(resolverOf("1000", four)["resolver"], "sequential");
    EXPECT_EQ(resolverOf("7000", four)["resolver"], "threads");
    EXPECT_EQ(resolverOf("7000", {"--threads", "2"})["resolver"], "sequential");
    EXPECT_EQ(resolverOf("100000", {"--threads", "1"})["resolver"], "sequential");
    EXPECT_EQ(resolverOf("100000", {"--threads", "4", "--law", "baseline"})["resolver"],
              "sequential");
    EXPECT_EQ(resolverOf("100000", {"--threads", "4", "--law", "continuous"})["resolver"],
              "threads");
    const Json many = resolverOf("100000", four);
    EXPECT_EQ(many["resolver"], "threads");
    EXPECT_EQ(many["requested_resolver"], "auto");
    EXPECT_EQ(many["threads"], 4);
    EXPECT_EQ(many["state_hash"], resolverOf("100000", {"--resolver", "sequential"})["state_hash"]);
}

/// A system gives no more threads than their stacks find room. Sanitizers need more than this
/// limit.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(Threads, ThatCannotBeStartedAreAnError) {
    Process shell("/bin/sh", Arguments{"-c", "ulimit -s 8192 && ulimit -v 3000000 && exec \"$@\"",
                                       "sh", QUADRILLE_PROGRAM} +
                                 cradle + Arguments{"--resolver", "threads", "--threads", "1024"});
    const ProcessResult result = shell.finish();
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_TRUE(contains(result.err, "1024 threads cannot be started, only ")) << result.err;
}
#endif

}  // namespace
}  // namespace quadrille
