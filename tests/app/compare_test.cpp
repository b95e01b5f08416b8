// collisionStress --compare: two runs from one start, held against each other.

#include <csignal>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"

namespace quadrille {
namespace {

class Compare : public ProgramTest {
  protected:
    Json comparisonOf(const Arguments& arguments) const {
        const Json summary = summaryOf(arguments);
        EXPECT_TRUE(summary.contains("comparison") && summary["comparison"].is_object());
        return summary["comparison"];
    }
};

const Arguments crowd = {"--scene", QUADRILLE_TEST_DATA "/golden/dense1600.toml"};

TEST_F(Compare, NeitherRunIsChangedByTheOther) {
    const Arguments run = crowd + Arguments{"--frames", "40"};
    const Json both = summaryOf(run + Arguments{"--compare", "impulse,continuous"});
    const Json first = summaryOf(run + Arguments{"--law", "impulse"});
    const Json second = summaryOf(run + Arguments{"--law", "continuous"});
    EXPECT_FALSE(first.contains("comparison"));
    EXPECT_EQ(both["state_hash"], first["state_hash"]);
    EXPECT_EQ(both["collisions"], first["collisions"]);
    EXPECT_EQ(both["law"], "impulse");
    const Json c = both["comparison"];
    EXPECT_EQ(c["beside"]["state_hash"], second["state_hash"]);
    EXPECT_EQ(c["beside"]["collisions"], second["collisions"]);
    EXPECT_EQ(c["beside"]["law"], "continuous");
    EXPECT_EQ(c["runs"], Json::array({"impulse", "continuous"}));
    EXPECT_EQ(c["same_state"], false);
}

/// `continuous` is the reference there.
TEST_F(Compare, SaysWhatTheErrorSays) {
    const Json s = summaryOf(
        crowd + Arguments{"--frames", "60", "--compare", "impulse,continuous", "--error"});
    const Json c = s["comparison"], e = s["error"];
    EXPECT_GT(c["wrong_bodies"], 100);
    EXPECT_EQ(c["wrong_bodies"], e["wrong_bodies"]);
    EXPECT_EQ(c["position_error"], e["position_error"]);
    EXPECT_EQ(c["matched"], e["matched_collisions"]);
    EXPECT_EQ(c["velocity_tolerance"], e["velocity_tolerance"]);
}

TEST_F(Compare, PrintsATableOverTime) {
    const ProcessResult result =
        runProgram(Arguments{"--headless"} + crowd +
                   Arguments{"--frames", "60", "--compare", "impulse,continuous"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(contains(result.out, "1: impulse, held against 2: continuous"));
    for (const char* column : {"time, s", "apart", "wrong", "missed", "invented", "overlap 1",
                               "overlap 2", "ms 1", "ms 2"}) {
        EXPECT_TRUE(contains(result.out, column)) << column;
    }
    // Twenty rows, three frames apart.
    std::size_t rows = 0;
    for (int frame = 3; frame <= 60; frame += 3) {
        char time[32];
        std::snprintf(time, sizeof time, "\n%11.6g ", frame / 60.0);
        rows += contains(result.out, time);
    }
    EXPECT_EQ(rows, 20u);
    EXPECT_TRUE(contains(result.out, "impulse held against continuous at 1 s"));
}

TEST_F(Compare, CsvHasARowForEachTimeInCommon) {
    const ProcessResult result =
        runProgram(Arguments{"--headless"} + crowd +
                   Arguments{"--law", "impulse", "--frames", "60", "--compare", "dt=1/240,1/60",
                             "--csv", "-", "--json", file("run.json")});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const Table table = parseTable(result.out);
    ASSERT_EQ(table.columns, (std::vector<std::string>{
                                 "frame", "time", "apart", "wrong_bodies", "missed", "invented",
                                 "matched", "position_median", "position_p99", "position_max",
                                 "overlap", "overlap_beside", "ms", "ms_beside", "same_state"}));
    ASSERT_EQ(table.rows.size(), 15u);
    for (std::size_t k = 0; k < table.rows.size(); ++k) {
        ASSERT_EQ(table.rows[k].size(), table.columns.size());
        EXPECT_EQ(table.rows[k][0], std::to_string(4 * (k + 1)));
        EXPECT_NEAR(numberOf(table.rows[k][1]), double(k + 1) / 60, 1e-12);
    }
    const Json c = parseJson(contentOf(path("run.json")))["comparison"];
    EXPECT_EQ(c["frame"], 60);
    EXPECT_EQ(c["beside"]["frames"], 15);
    const auto& last = table.rows.back();
    EXPECT_EQ(numberOf(last[2]), c["apart"]);
    EXPECT_EQ(numberOf(last[3]), c["wrong_bodies"]);
    EXPECT_EQ(numberOf(last[4]), c["missed"]);
    EXPECT_EQ(numberOf(last[5]), c["invented"]);
    EXPECT_EQ(numberOf(last[6]), c["matched"]);
}

TEST_F(Compare, WithTheExactLawTheLengthOfAStepChangesNothing) {
    const Json c = comparisonOf(crowd + Arguments{"--frames", "15", "--compare", "dt=1/16,1/64"});
    EXPECT_EQ(c["runs"], Json::array({"dt 1/16", "dt 1/64"}));
    EXPECT_EQ(c["same_state"], true);
    EXPECT_EQ(c["wrong_bodies"], 0);
    EXPECT_EQ(c["missed"], 0);
    EXPECT_GT(c["matched"], 100);
    EXPECT_EQ(c["beside"]["frames"], 60);
}

TEST_F(Compare, WhatMustNotChangeTheResultDoesNot) {
    for (const char* difference :
         {"resolver=sequential,threads", "partitioner=static-grid,quadtree", "threads=1,2",
          "max-per-cell=5,50", "cell-size=13,26", "rebuild=skin,skin:1"}) {
        SCOPED_TRACE(difference);
        const Json c = comparisonOf(
            crowd + Arguments{"--law", "impulse", "--frames", "20", "--compare", difference});
        EXPECT_EQ(c["same_state"], true);
        EXPECT_EQ(c["apart"], 0);
        EXPECT_EQ(c["missed"], 0);
        EXPECT_EQ(c["invented"], 0);
    }
}

TEST_F(Compare, TwoPrecisionsStartFromThePlacesThatBothCanHold) {
    const std::string scene = write("tenths.toml", R"(
format = 1
name = "tenths"
[world]
size = [100, 100]
[step]
dt = 0.015625
[[body]]
position = [0.1, 0]
size = [3, 3]
velocity = [20.1, 0.7]
[[body]]
position = [-20, 10]
size = [3, 3]
velocity = [0.3, 0]
)");
    const Json c =
        comparisonOf({"--scene", scene, "--frames", "1", "--compare", "precision=double,float"});
    EXPECT_EQ(c["beside"]["precision"], "float");
    EXPECT_EQ(c["wrong_bodies"], 0);
    EXPECT_LT(c["position_error"]["max"], 1e-4);
}

TEST_F(Compare, RunsMayDifferInSeveralThings) {
    const Json c =
        comparisonOf(crowd + Arguments{"--frames", "8", "--compare", "impulse,continuous",
                                       "--compare", "dt=1/240,1/60"});
    EXPECT_EQ(c["runs"], Json::array({"impulse, dt 1/240", "continuous, dt 1/60"}));
    EXPECT_EQ(c["frame"], 8);
    EXPECT_EQ(c["beside"]["frames"], 2);
    EXPECT_EQ(c["beside"]["law"], "continuous");
}

TEST_F(Compare, ThePolicyThatMissesPairsRunsWithALawThatBothCan) {
    const ProcessResult result =
        runProgram({"--headless", "--scene", "imbalanced-clear", "--entities", "200", "--frames",
                    "12", "--compare", "rebuild=skin,every:10", "--json", "-"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const Json s = parseJson(result.out);
    EXPECT_EQ(s["law"], "impulse");
    EXPECT_EQ(s["comparison"]["beside"]["law"], "impulse");
    EXPECT_GT(s["comparison"]["beside"]["missed_pairs"], 0);
    const std::size_t warning = result.err.find("warning");
    EXPECT_NE(warning, std::string::npos);
    EXPECT_EQ(result.err.find("warning", warning + 1), std::string::npos) << result.err;
}

TEST_F(Compare, GoesOnFromASnapshot) {
    summaryOf(crowd + Arguments{"--frames", "10", "--save", file("snapshot")});
    const Json c = comparisonOf({"--load", file("snapshot"), "--frames", "8", "--compare",
                                 "impulse,continuous", "--compare", "dt=1/120,1/60"});
    EXPECT_NEAR(c["time"].get<double>(), 4.0 / 60, 1e-12);
    EXPECT_GT(c["matched"], 10);
}

TEST_F(Compare, RunsThatHaveNotMetAreNotCompared) {
    const Arguments run = crowd + Arguments{"--frames", "2", "--compare", "dt=1/240,1/60"};
    EXPECT_TRUE(summaryOf(run)["comparison"].is_null());
    EXPECT_TRUE(contains(runProgram(Arguments{"--headless"} + run).out, "have not met"));
}

TEST_F(Compare, ASignalWritesWhatThereIs) {
    Process process(QUADRILLE_PROGRAM, Arguments{"--headless"} + crowd +
                                           Arguments{"--compare", "impulse,continuous", "--csv",
                                                     "-", "--json", file("run.json")});
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.out(), "\n20,"); }));
    process.sendSignal(SIGTERM);
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exitCode, 128 + SIGTERM);
    const Json s = parseJson(contentOf(path("run.json")));
    EXPECT_EQ(s["interrupted"], true);
    EXPECT_EQ(s["comparison"]["frame"], parseTable(result.out).rows.size());
}

void expectRefused(const Arguments& compare, const std::vector<std::string>& words) {
    const Arguments run = {"--headless", "--scene", "cradle", "--frames", "1"};
    expectRefusal(run + compare, 2, words);
}

TEST(CompareUsage, WhatIsNoDifferenceIsRefused) {
    for (const char* text : {"impulse", "impulse,", ",impulse", "a,b,c", "", "dt=1/60"}) {
        expectRefused({"--compare", text}, {"--compare", text});
    }
    expectRefused({"--compare", "impulse,impulse"}, {"--compare", "twice"});
    expectRefused({"--compare", "scene=pile,pi"}, {"scene", "law", "rebuild"});
    expectRefused({"--compare", "precison=double,float"}, {"did you mean 'precision'"});
    expectRefused({"--compare", "impulse,continous"}, {"did you mean 'continuous'"});
    expectRefused({"--compare", "dt=1/60,1/0"}, {"--dt", "1/0"});
    expectRefused({"--compare", "dt=1/60,0"}, {"--dt"});
}

TEST(CompareUsage, NothingIsSaidTwice) {
    expectRefused({"--law", "baseline", "--compare", "impulse,continuous"}, {"--law"});
    expectRefused({"--compare", "impulse,continuous", "--compare", "law=baseline,impulse"},
                  {"law", "twice"});
}

TEST(CompareUsage, StepsThatNeverMeet) {
    expectRefused({"--compare", "dt=0.01,0.0100001"}, {"--compare", "0.0100001", "meet"});
}

TEST(CompareUsage, LawsThatDoNotRun) {
    expectRefused({"--compare", "impulse,continuous", "--rebuild", "every:3"}, {"misses no pair"});
}

}  // namespace
}  // namespace quadrille
