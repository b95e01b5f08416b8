#include <csignal>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program.hpp"

namespace quadrille {
namespace {

class Signal : public ProgramTest, public testing::WithParamInterface<int> {};

/// Runs for ever and writes everything there is.
Arguments endlessRun(const Arguments& outputs) {
    return Arguments{"--headless", "--scene", "imbalanced", "--report-every", "0.05"} + outputs;
}

TEST_P(Signal, EndsTheRunAndWritesWhatWasAskedFor) {
    Process process(QUADRILLE_PROGRAM,
                    endlessRun({"--json", file("run.json"), "--csv", file("frames.csv"),
                                "--dump-state", file("state.csv"), "--dump-events",
                                file("events.csv"), "--save", file("snapshot")}));
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.out(), "ms/frame"); }))
        << process.err();
    EXPECT_FALSE(std::filesystem::exists(path("run.json")));
    process.sendSignal(GetParam());
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_FALSE(result.timedOut);
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(contains(result.out, "summary"));
    EXPECT_TRUE(contains(result.out, "state hash"));
    ASSERT_EQ(files(), (std::vector<std::string>{"events.csv", "frames.csv", "run.json", "snapshot",
                                                 "state.csv"}));

    const Json summary = Json::parse(contentOf(path("run.json")));
    ASSERT_GT(summary["frames"], 0);
    const Table frames = parseTable(contentOf(path("frames.csv")));
    ASSERT_EQ(frames.rows.size(), summary["frames"]);
    EXPECT_EQ(frames.rows.back().size(), frames.columns.size());
    const Table events = parseTable(contentOf(path("events.csv")));
    EXPECT_EQ(events.rows.size(), summary["collisions"]);
    const Table state = parseTable(contentOf(path("state.csv")));
    ASSERT_EQ(state.rows.size(), summary["entities"]);
    EXPECT_EQ(state.rows.back().size(), 5u);
    const Json resumed = summaryOf({"--load", file("snapshot"), "--frames", "0"});
    EXPECT_EQ(resumed["state_hash"], summary["state_hash"]);
}

TEST_P(Signal, IsHeededWhileDataGoesToStdout) {
    Process process(QUADRILLE_PROGRAM, endlessRun({"--json", "-"}));
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.err(), "ms/frame"); }));
    process.sendSignal(GetParam());
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_TRUE(contains(result.err, "summary"));
    const Json summary = Json::parse(result.out, nullptr, false);
    ASSERT_TRUE(summary.is_object()) << result.out;
    EXPECT_GT(summary["frames"], 0);
}

INSTANTIATE_TEST_SUITE_P(Run, Signal, testing::Values(SIGINT, SIGTERM), [](const auto& test) {
    return test.param == SIGINT ? "interrupt" : "terminate";
});

class LongRun : public ProgramTest {};

/// Results grow under another name, and the old ones stay until the new ones are complete.
TEST_F(LongRun, KeepsOldResultsUntilItsEnd) {
    write("frames.csv", "old");
    Process process(QUADRILLE_PROGRAM, endlessRun({"--csv", file("frames.csv")}));
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.out(), "ms/frame"); }));
    EXPECT_EQ(contentOf(path("frames.csv")), "old");
    process.sendSignal(SIGINT);
    EXPECT_EQ(process.finish().exitCode, 0);
    EXPECT_TRUE(contains(contentOf(path("frames.csv")), "frame,"));
    EXPECT_EQ(files(), std::vector<std::string>{"frames.csv"});
}

}  // namespace
}  // namespace quadrille
