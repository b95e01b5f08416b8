// collisionStress --error: the run held against the reference.

#include <csignal>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program.hpp"

namespace quadrille {
namespace {

class Error : public ProgramTest {
  protected:
    /// The key `error` of a run that must succeed.
    Json errorOf(const Arguments& arguments) const {
        const Json summary = summaryOf(Arguments{"--error"} + arguments);
        EXPECT_TRUE(summary.contains("error") && summary["error"].is_object());
        return summary["error"];
    }
};

std::string golden(const std::string& name) {
    return QUADRILLE_TEST_DATA "/golden/" + name + ".toml";
}

TEST_F(Error, JsonHasTheKeysOfTheContract) {
    const Json e = errorOf({"--scene", "imbalanced-clear", "--frames", "20"});
    EXPECT_TRUE(e["reference"].is_string());
    for (const char* key :
         {"horizon_s", "recall", "precision", "f1", "rate_bias", "wrong_body_fraction",
          "velocity_tolerance", "length_px", "energy_drift", "speed_drift", "broad_phase_recall"}) {
        EXPECT_TRUE(e.contains(key) && e[key].is_number()) << key;
    }
    for (const char* key : {"exact_collisions", "collisions", "matched_collisions", "wrong_bodies",
                            "escaped", "overlapping_pairs"}) {
        EXPECT_TRUE(e.contains(key) && e[key].is_number_unsigned()) << key;
    }
    for (const char* key : {"median", "p99", "max"}) {
        EXPECT_TRUE(e["position_error"][key].is_number()) << key;
    }
    for (const char* key : {"max", "mean"}) EXPECT_TRUE(e["overlap"][key].is_number()) << key;
    for (const char* key : {"x", "y"}) EXPECT_TRUE(e["wall_identity"][key].is_number()) << key;
    EXPECT_NEAR(e["horizon_s"].get<double>(), 20.0 / 60, 1e-12);
}

TEST_F(Error, IsNoneForTheLawContinuousOnTheGoldenRuns) {
    for (const std::string name : {"small64", "A1700", "dense1600"}) {
        SCOPED_TRACE(name);
        const Json e = errorOf({"--scene", golden(name), "--law", "continuous", "--frames", "60"});
        EXPECT_GT(e["exact_collisions"], 30);
        EXPECT_EQ(e["recall"], 1);
        EXPECT_EQ(e["precision"], 1);
        EXPECT_EQ(e["wrong_bodies"], 0);
        EXPECT_EQ(e["position_error"]["max"], 0);
        EXPECT_EQ(e["overlap"]["max"], 0);
        EXPECT_EQ(e["rate_bias"], 0);
        EXPECT_EQ(e["broad_phase_recall"], 1);
    }
}

TEST_F(Error, StandsBesideARunThatItDoesNotChange) {
    const Arguments run = {"--scene", golden("dense1600"), "--law", "impulse", "--frames", "30"};
    const Json plain = summaryOf(run);
    const Json measured = summaryOf(run + Arguments{"--error"});
    EXPECT_FALSE(plain.contains("error"));
    EXPECT_EQ(measured["state_hash"], plain["state_hash"]);
    EXPECT_EQ(measured["collisions"], plain["collisions"]);
    EXPECT_EQ(measured["error"]["collisions"], plain["collisions"]);
    EXPECT_LT(measured["error"]["recall"], 1);
    EXPECT_GT(measured["error"]["recall"], 0.3);
}

/// The reference and the audit of pairs take many times as long as the steps; a mean over many
/// frames of tens of microseconds cannot hide that.
TEST_F(Error, DoesNotEnterTheTimeOfAFrame) {
    const Arguments run = {"--scene", golden("dense1600"), "--frames", "200", "--error"};
    const Json s = summaryOf(run + Arguments{"--profile"});
    double phases = 0;
    for (const char* phase : {"integrate", "partition", "resolve"}) {
        phases += s["phases_ms"][phase].get<double>();
    }
    // What the profile does not see of a frame is little beside what it sees; the audit alone would
    // more than double it.
    EXPECT_LT(s["ms_per_frame"]["mean"].get<double>(), 1.5 * phases);
}

TEST_F(Error, CountsMissedPairsOfEveryPartitioner) {
    for (const char* name : {"brute-force", "static-grid", "quadtree", "semi-static-quadtree"}) {
        SCOPED_TRACE(name);
        const Json s = summaryOf({"--scene", "imbalanced-clear", "--entities", "400", "--frames",
                                  "8", "--error", "--partitioner", name});
        EXPECT_EQ(s["missed_pairs"], 0);
        EXPECT_EQ(s["missed_pairs_frames"], 8);
        EXPECT_EQ(s["error"]["broad_phase_recall"], 1);
        EXPECT_GT(s["error"]["overlapping_pairs"], 100);
    }
    const Json stale = summaryOf({"--scene", "imbalanced-clear", "--entities", "400", "--law",
                                  "impulse", "--frames", "8", "--error", "--rebuild", "every:10"});
    EXPECT_GT(stale["missed_pairs"], 0);
    EXPECT_LT(stale["error"]["broad_phase_recall"], 1);
}

TEST_F(Error, LooksAtASampleOfTheFramesOfLargeScenes) {
    const Json s = summaryOf(
        {"--scene", "balanced-scaled", "--entities", "20001", "--frames", "40", "--error"});
    EXPECT_GE(s["missed_pairs_frames"], 1);
    EXPECT_LT(s["missed_pairs_frames"], 20);
    EXPECT_EQ(s["missed_pairs"], 0);
}

TEST_F(Error, StartsFromALoadedState) {
    ASSERT_EQ(runProgram({"--headless", "--scene", golden("small64"), "--law", "continuous",
                          "--frames", "60", "--save", file("snapshot")})
                  .exitCode,
              0);
    const Json e = errorOf({"--load", file("snapshot"), "--frames", "60"});
    EXPECT_NEAR(e["horizon_s"].get<double>(), 1, 1e-12);
    EXPECT_GT(e["exact_collisions"], 100);
    EXPECT_EQ(e["recall"], 1);
    EXPECT_EQ(e["wrong_bodies"], 0);
}

TEST_F(Error, OfFloatIsMeasured) {
    const Json e = errorOf({"--scene", golden("A1700"), "--law", "continuous", "--precision",
                            "float", "--frames", "120"});
    EXPECT_EQ(e["recall"], 1);
    EXPECT_EQ(e["wrong_bodies"], 0);
    EXPECT_LT(e["position_error"]["max"], 1e-3);
}

TEST_F(Error, IsPrintedForAPersonAndShowsNoProgressInAPipe) {
    const ProcessResult result =
        runProgram({"--headless", "--scene", "imbalanced-clear", "--frames", "20", "--error"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    for (const char* word : {"error over", "recall", "precision", "wrong bodies", "position error",
                             "overlap", "broad phase"}) {
        EXPECT_TRUE(contains(result.out, word)) << word;
    }
    EXPECT_FALSE(contains(result.out, "\r"));
}

TEST_F(Error, NeedsAFrame) {
    expectRefusal({"--headless", "--scene", "cradle", "--error", "--frames", "0"}, 2,
                  {"--error", "--frames"});
}

TEST_F(Error, IsWrittenUpToTheLastFrameWhenInterrupted) {
    // Frames so short that the run is never ended inside one, which leaves no error to write.
    Process process(QUADRILLE_PROGRAM,
                    {"--headless", "--scene", "imbalanced-clear", "--entities", "200", "--error",
                     "--report-every", "0.05", "--json", file("run.json")});
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.out(), "ms/frame"); }));
    process.sendSignal(SIGINT);
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exitCode, 128 + SIGINT);
    const Json s = parseJson(contentOf(path("run.json")));
    ASSERT_GT(s["frames"], 0);
    EXPECT_NEAR(s["error"]["horizon_s"].get<double>(),
                s["frames"].get<double>() * s["dt"].get<double>(), 1e-9);
    EXPECT_GT(s["error"]["exact_collisions"], 0);
}

}  // namespace
}  // namespace quadrille
