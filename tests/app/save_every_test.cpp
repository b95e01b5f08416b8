// --save-every: what a run leaves behind that is ended by what nothing can be done about.

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <gtest/gtest.h>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "program.hpp"

namespace quadrille {
namespace {

using Seconds = std::chrono::duration<double>;

class SaveEvery : public ProgramTest {
  protected:
    std::uint64_t stepsIn(const std::string& snapshot) const {
        return summaryOf({"--load", snapshot, "--frames", "0"})["steps_done"];
    }
    bool saved() const { return std::filesystem::exists(path("snapshot")); }
};

class KilledRun : public SaveEvery, public testing::WithParamInterface<Arguments> {};

/// Whatever the moment, be it in a frame or while a snapshot is written, the run goes on from the
/// last snapshot and ends as one that nothing has disturbed.
TEST_P(KilledRun, GoesOnFromTheLastSnapshot) {
    constexpr int kills = 8;
    const unsigned seed = std::random_device()();
    std::cout << "seed " << seed << '\n';
    std::mt19937 random(seed);
    const Arguments& scene = GetParam();
    const Arguments saving = {"--save", file("snapshot"), "--save-every", "1"};
    std::uint64_t steps = 0;
    for (int kill = 0; kill < kills; ++kill) {
        Process process(QUADRILLE_PROGRAM,
                        Arguments{"--headless"} +
                            (saved() ? Arguments{"--load", file("snapshot")} : scene) + saving);
        const std::string before = contentOf(path("snapshot"));
        // Beyond its start, which takes most of a short run.
        ASSERT_TRUE(process.waitUntil([&] { return contentOf(path("snapshot")) != before; }));
        std::this_thread::sleep_for(
            Seconds(std::uniform_real_distribution<double>(0, 0.1)(random)));
        process.sendSignal(SIGKILL);
        ASSERT_EQ(process.finish().exitCode, 128 + SIGKILL);
        const std::uint64_t now = stepsIn(file("snapshot"));
        EXPECT_GT(now, steps);
        steps = now;
    }
    const Json whole = summaryOf(scene + Arguments{"--frames", std::to_string(steps + 5)});
    const Json resumed = summaryOf({"--load", file("snapshot"), "--frames", "5"});
    EXPECT_EQ(resumed["steps_done"], whole["steps_done"]);
    EXPECT_EQ(resumed["state_hash"], whole["state_hash"]);
    EXPECT_GT(whole["collisions"], 0);
}

INSTANTIATE_TEST_SUITE_P(SaveEvery, KilledRun,
                         testing::Values(Arguments{"--scene", "imbalanced", "--law", "continuous"},
                                         Arguments{"--scene", "pile", "--law", "impulse",
                                                   "--precision", "float"}),
                         [](const auto& test) { return test.param[3]; });

TEST_F(SaveEvery, CountsTheFramesOfTheRun) {
    const Arguments saving = {"--save", file("snapshot"), "--save-every", "7"};
    summaryOf({"--scene", "cradle", "--frames", "10", "--save", file("start")});
    Process process(QUADRILLE_PROGRAM, Arguments{"--headless", "--load", file("start")} + saving);
    ASSERT_TRUE(process.waitUntil([&] { return saved(); }));
    process.sendSignal(SIGKILL);
    process.finish();
    const std::uint64_t frames = stepsIn(file("snapshot")) - 10;
    EXPECT_GT(frames, 0u);
    EXPECT_EQ(frames % 7, 0u);
}

TEST_F(SaveEvery, LeavesTheStateOfTheEnd) {
    const Arguments saving = {"--save", file("snapshot"), "--save-every", "7"};
    const Json run = summaryOf(Arguments{"--scene", "imbalanced", "--frames", "17"} + saving);
    const Json end = summaryOf({"--load", file("snapshot"), "--frames", "0"});
    EXPECT_EQ(end["steps_done"], 17);
    EXPECT_EQ(end["state_hash"], run["state_hash"]);
    EXPECT_EQ(files(), std::vector<std::string>{"snapshot"});
}

TEST_F(SaveEvery, ChangesNoResult) {
    for (const Arguments& run :
         {Arguments{"--scene", "imbalanced"}, Arguments{"--scene", "pile", "--precision", "float"},
          Arguments{"--scene", "imbalanced", "--law", "impulse"},
          Arguments{"--scene", "imbalanced", "--law", "baseline"}}) {
        SCOPED_TRACE(testing::PrintToString(run));
        const Arguments frames = run + Arguments{"--frames", "30"};
        const Json plain = summaryOf(frames);
        const Json saving =
            summaryOf(frames + Arguments{"--save", file("snapshot"), "--save-every", "1"});
        for (const char* key :
             {"state_hash", "collisions", "contacts", "pairs_tested", "rebuilds"}) {
            EXPECT_EQ(saving[key], plain[key]) << key;
        }
    }
}

/// A disk that is away for a while costs no result.
TEST_F(SaveEvery, GoesOnWhenASnapshotCannotBeWritten) {
    std::filesystem::create_directory(path("there"));
    Process process(QUADRILLE_PROGRAM,
                    {"--headless", "--scene", "cradle", "--json", file("run.json"), "--save",
                     file("there/snapshot"), "--save-every", "1"});
    ASSERT_TRUE(process.waitUntil([&] { return std::filesystem::exists(path("there/snapshot")); }));
    std::filesystem::rename(path("there"), path("away"));
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.err(), "\n"); }));
    std::this_thread::sleep_for(Seconds(0.05));
    std::filesystem::rename(path("away"), path("there"));
    process.sendSignal(SIGINT);
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exitCode, 128 + SIGINT);
    EXPECT_TRUE(contains(result.err, "warning: " + file("there/snapshot") + ": ")) << result.err;
    EXPECT_EQ(result.err.find('\n'), result.err.size() - 1) << result.err;
    EXPECT_EQ(stepsIn(file("there/snapshot")),
              parseJson(contentOf(path("run.json")))["steps_done"]);
}

}  // namespace
}  // namespace quadrille
