#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "program.hpp"

namespace quadrille {
namespace {

struct ResumeCase {
    const char* name;
    Arguments run;   ///< of both parts and of the whole
    Arguments more;  ///< what a snapshot does not keep
};

void PrintTo(const ResumeCase& c, std::ostream* out) { *out << c.name; }

class Resume : public ProgramTest, public testing::WithParamInterface<ResumeCase> {};

TEST_P(Resume, GivesTheBitsOfAnUninterruptedRun) {
    const Arguments run = GetParam().run + GetParam().more;
    const Json whole = summaryOf(run + Arguments{"--frames", "60"});
    const Json first = summaryOf(run + Arguments{"--frames", "25", "--save", file("snapshot")});
    const Json second =
        summaryOf(GetParam().more + Arguments{"--load", file("snapshot"), "--frames", "35"});
    ASSERT_GT(first["collisions"], 0);
    ASSERT_GT(second["collisions"], 0);
    EXPECT_NE(first["state_hash"], whole["state_hash"]);
    EXPECT_EQ(second["state_hash"], whole["state_hash"]);
    for (const char* key :
         {"scene", "seed", "entities", "dt", "law", "precision", "partitioner", "restitution"}) {
        EXPECT_EQ(second[key], whole[key]) << key;
    }
    EXPECT_EQ(second["frames"], 35);
    EXPECT_EQ(first["collisions"].get<int>() + second["collisions"].get<int>(),
              whole["collisions"].get<int>());
    EXPECT_EQ(second["kinetic_energy"]["start"], first["kinetic_energy"]["end"]);
    EXPECT_EQ(files(), std::vector<std::string>{"snapshot"});
}

INSTANTIATE_TEST_SUITE_P(
    Snapshot, Resume,
    testing::Values(ResumeCase{"double", {"--scene", "imbalanced"}, {}},
                    ResumeCase{"float", {"--scene", "imbalanced", "--precision", "float"}, {}},
                    ResumeCase{"baseline",
                               {"--scene", "imbalanced", "--law", "baseline"},
                               {"--partitioner", "static-grid"}},
                    ResumeCase{"gravity", {"--scene", "pile"}, {}},
                    ResumeCase{"options",
                               {"--scene", "pile", "--seed", "5", "--entities", "500", "--dt",
                                "0.01", "--restitution", "0.5"},
                               {"--partitioner", "quadtree"}}),
    [](const auto& test) { return test.param.name; });

class SavedRun : public ProgramTest {};

TEST_F(SavedRun, OutputsGoOnWhereTheFirstPartEnded) {
    const Arguments scene = {"--scene", "imbalanced"};
    const Arguments outputs = {"--csv", file("frames.csv"), "--dump-events", file("events.csv")};
    summaryOf(scene + outputs + Arguments{"--frames", "20"});
    const Table events = parseTable(contentOf(path("events.csv")));
    summaryOf(scene + Arguments{"--frames", "12", "--save", file("snapshot")});
    summaryOf(Arguments{"--load", file("snapshot"), "--frames", "8"} + outputs);
    const Table rest = parseTable(contentOf(path("events.csv")));
    ASSERT_GT(rest.rows.size(), 0u);
    ASSERT_LT(rest.rows.size(), events.rows.size());
    EXPECT_TRUE(std::equal(rest.rows.rbegin(), rest.rows.rend(), events.rows.rbegin()));
    const Table frames = parseTable(contentOf(path("frames.csv")));
    ASSERT_EQ(frames.rows.size(), 8u);
    EXPECT_EQ(frames.rows.front()[0], "13");
}

TEST_F(SavedRun, MayReplaceTheSnapshotItCameFrom) {
    const Json whole = summaryOf({"--scene", "imbalanced", "--frames", "30"});
    summaryOf({"--scene", "imbalanced", "--frames", "10", "--save", file("snapshot")});
    for (int part = 0; part < 2; ++part) {
        const Json s =
            summaryOf({"--load", file("snapshot"), "--frames", "10", "--save", file("snapshot")});
        EXPECT_EQ(s["state_hash"] == whole["state_hash"], part == 1);
    }
}

class OneAnswer : public ProgramTest, public testing::WithParamInterface<const char*> {};

TEST_P(OneAnswer, ForEveryPartitioner) {
    const Arguments run = {"--scene",  "imbalanced", "--law",       "impulse",
                           "--frames", "30",         "--precision", GetParam()};
    const Json oracle = summaryOf(run + Arguments{"--partitioner", "brute-force"});
    ASSERT_GT(oracle["collisions"], 0);
    const std::vector<Arguments> partitioners = {
        {"--partitioner", "static-grid"},
        {"--partitioner", "static-grid", "--cell-size", "17,45"},
        {"--partitioner", "static-grid", "--cell-size", "5"},
        {"--partitioner", "quadtree"},
        {"--partitioner", "quadtree", "--max-depth", "3", "--max-per-cell", "5"},
        {"--partitioner", "quadtree", "--max-depth", "0"},
        {"--partitioner", "semi-static-quadtree"},
        {"--partitioner", "semi-static-quadtree", "--rebuild", "skin:4"},
        {"--partitioner", "semi-static-quadtree", "--rebuild", "every:1"},
    };
    for (const Arguments& partitioner : partitioners) {
        const Json s = summaryOf(run + partitioner);
        EXPECT_EQ(s["state_hash"], oracle["state_hash"]) << testing::PrintToString(partitioner);
        EXPECT_EQ(s["contacts"], oracle["contacts"]) << testing::PrintToString(partitioner);
        EXPECT_EQ(s["collisions"], oracle["collisions"]) << testing::PrintToString(partitioner);
        EXPECT_EQ(s["partitioner"], partitioner[1]);
    }
}

INSTANTIATE_TEST_SUITE_P(StateHash, OneAnswer, testing::Values("double", "float"),
                         [](const auto& test) { return identifier(test.param); });

}  // namespace
}  // namespace quadrille
