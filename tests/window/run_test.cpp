#include <csignal>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include "scenes.hpp"
#include "window_run.hpp"

namespace quadrille {
namespace {

class WindowRun : public WindowTest {};

TEST_F(WindowRun, HasTheOutputsOfARunWithoutAWindow) {
    const Arguments run = {"--scene", "imbalanced", "--frames", "120", "--entities", "50"};
    start(run + Arguments{"--speed", "max", "--profile", "--json", file("run.json"), "--csv",
                          file("frames.csv"), "--dump-state", file("state.csv"), "--dump-events",
                          file("events.csv"), "--save", file("snapshot"), "--screenshot",
                          file("last.png")});
    const ProcessResult result = program_->finish();
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(contains(result.out, "summary"));
    const Json summary = parseJson(contentOf(path("run.json")));
    const Json headless = summaryOf(run + Arguments{"--dump-events", file("other.csv")});
    EXPECT_EQ(summary["frames"], 120);
    EXPECT_EQ(summary["state_hash"], headless["state_hash"]);
    EXPECT_EQ(summary["collisions"], headless["collisions"]);
    EXPECT_EQ(contentOf(path("events.csv")), contentOf(path("other.csv")));
    EXPECT_EQ(parseTable(contentOf(path("frames.csv"))).rows.size(), 120u);
    EXPECT_EQ(parseTable(contentOf(path("state.csv"))).rows.size(), summary["entities"]);
    EXPECT_EQ(summaryOf({"--load", file("snapshot"), "--frames", "0"})["state_hash"],
              summary["state_hash"]);

    EXPECT_EQ(summary["window"]["width"], width);
    EXPECT_EQ(summary["window"]["height"], height);
    EXPECT_GE(summary["window"]["pictures"], 120);
    EXPECT_TRUE(headless["window"].is_null());
    for (const char* phase : {"gui", "prepare", "draw", "present"}) {
        EXPECT_GT(summary["phases_ms"][phase], 0) << phase;
        EXPECT_TRUE(contains(result.out, phase)) << phase;
    }
    const Image image = readPng(path("last.png"));
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
}

TEST_F(WindowRun, KeepsToTheStepWhateverTheSpeed) {
    const Arguments run = {"--scene", "imbalanced", "--frames", "90", "--entities", "20"};
    const Json headless = summaryOf(run);
    for (const char* speed : {"8", "1"}) {
        start(run + Arguments{"--speed", speed, "--json", file("run.json")});
        ASSERT_EQ(program_->finish().exitCode, 0);
        const Json summary = parseJson(contentOf(path("run.json")));
        EXPECT_EQ(summary["state_hash"], headless["state_hash"]);
        EXPECT_TRUE(summary["phases_ms"].is_null());
    }
}

TEST_F(WindowRun, MeasuresTheErrorAsWithoutAWindow) {
    const Arguments run = {"--scene", "imbalanced-clear", "--frames", "20", "--error"};
    start(run + Arguments{"--speed", "max", "--json", file("run.json")});
    const ProcessResult result = program_->finish();
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const Json error = parseJson(contentOf(path("run.json")))["error"];
    EXPECT_TRUE(error.is_object());
    EXPECT_EQ(error, summaryOf(run)["error"]);
}

TEST_F(WindowRun, ShowsBodiesOfASnapshotThatHasNoColours) {
    const std::string scene = write("still.toml", stillScene);
    summaryOf({"--scene", scene, "--frames", "1", "--save", file("snapshot")});
    start({"--load", file("snapshot"), "--frames", "0", "--screenshot", file("a.png")});
    ASSERT_EQ(program_->finish().exitCode, 0);
    const Image image = readPng(path("a.png"));
    const Place red = placeOf(stillWidth, stillHeight, -60, 30);
    ASSERT_EQ(image.width, width);
    EXPECT_FALSE(near(image.at(red.x, red.y), background, 30));
}

TEST_F(WindowRun, EndsAfterItsDurationEvenIfPaused) {
    start({"--scene", "cradle", "--paused", "--duration", "0.5", "--json", "-"});
    const ProcessResult result = program_->finish();
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(parseJson(result.out)["frames"], 0);
}

TEST_F(WindowRun, TheCloseButtonEndsItCleanly) {
    startPaused(write("still.toml", stillScene),
                {"--json", file("run.json"), "--screenshot", file("last.png")});
    const ProcessResult result = close();
    EXPECT_TRUE(contains(result.out, "summary"));
    EXPECT_EQ(parseJson(contentOf(path("run.json")))["frames"], 0);
    EXPECT_EQ(readPng(path("last.png")).width, width);
}

class WindowSignal : public WindowTest, public testing::WithParamInterface<int> {};

TEST_P(WindowSignal, EndsItCleanly) {
    start({"--scene", "imbalanced", "--json", file("run.json")});
    ASSERT_TRUE(titleHas("step")) << program_->err();
    program_->sendSignal(GetParam());
    const ProcessResult result = program_->finish();
    EXPECT_EQ(result.exitCode, 128 + GetParam());
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(parseJson(contentOf(path("run.json")))["interrupted"], true);
}

INSTANTIATE_TEST_SUITE_P(Run, WindowSignal, testing::Values(SIGINT, SIGTERM), [](const auto& test) {
    return test.param == SIGINT ? "interrupt" : "terminate";
});

TEST_F(WindowRun, AScreenshotThatCannotBeWrittenIsAnError) {
    start({"--scene", "cradle", "--frames", "2", "--screenshot", file("none/a.png")});
    const ProcessResult result = program_->finish();
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_TRUE(contains(result.err, "a.png")) << result.err;
}

TEST_F(WindowRun, ABadSceneIsRefusedBeforeAWindowOpens) {
    start({"--scene", write("bad.toml", "format = 2")});
    const ProcessResult result = program_->finish();
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_TRUE(contains(result.err, "bad.toml")) << result.err;
}

}  // namespace
}  // namespace quadrille
