#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include "window_run.hpp"

namespace quadrille {
namespace {

class WindowSwitch : public WindowTest {
  protected:
    const Arguments scene_ = {"--scene", "imbalanced",    "--entities",
                              "50",      "--partitioner", "quadtree"};

    void startPausedRun(const Arguments& more) {
        start(scene_ + Arguments{"--paused"} + more);
        ASSERT_TRUE(titleHas("step 0, paused")) << program_->err();
        screen_->focus();
    }
};

/// Partitioners that find every pair give one answer, whenever they are changed.
TEST_F(WindowSwitch, APartitionerThatIsChangedLiveChangesNothing) {
    startPausedRun({"--frames", "40", "--json", file("run.json")});
    int step = 0;
    for (const char* key : {"1", "2", "4", "3", "2"}) {
        screen_->press(key);
        for (int i = 0; i < 3; ++i) screen_->press("period");
        step += 3;
        ASSERT_TRUE(titleHas("step " + std::to_string(step) + ",")) << key;
    }
    screen_->press("space");
    ASSERT_EQ(program_->finish().exitCode, 0);
    const Json summary = parseJson(contentOf(path("run.json")));
    EXPECT_EQ(summary["partitioner"], "static-grid");
    EXPECT_EQ(summary["frames"], 40);
    EXPECT_EQ(summary["state_hash"], summaryOf(scene_ + Arguments{"--frames", "40"})["state_hash"]);
}

TEST_F(WindowSwitch, ALawThatIsChangedLiveGoesOnFromTheState) {
    startPausedRun({"--json", file("run.json"), "--dump-state", file("state.csv")});
    for (int i = 0; i < 5; ++i) screen_->press("period");
    ASSERT_TRUE(titleHas("step 5,"));
    screen_->press("l");  // from the last of the laws to the first
    ASSERT_EQ(close().exitCode, 0);
    const Json summary = parseJson(contentOf(path("run.json")));
    EXPECT_EQ(summary["law"], "baseline");
    // Nothing has moved by the change.
    EXPECT_EQ(summary["state_hash"], summaryOf(scene_ + Arguments{"--frames", "5"})["state_hash"]);
}

TEST_F(WindowSwitch, AResolverThatIsChangedLiveChangesNothing) {
    startPausedRun({"--frames", "30", "--threads", "2", "--json", file("run.json")});
    screen_->press("period");
    ASSERT_TRUE(titleHas("step 1,"));
    screen_->press("t");
    screen_->press("space");
    ASSERT_EQ(program_->finish().exitCode, 0);
    const Json summary = parseJson(contentOf(path("run.json")));
    EXPECT_EQ(summary["resolver"], "threads");
    EXPECT_EQ(summary["threads"], 2);
    EXPECT_EQ(summary["state_hash"], summaryOf(scene_ + Arguments{"--frames", "30"})["state_hash"]);
}

TEST_F(WindowSwitch, ALawThatTheResolverDoesNotKnowRunsOnTheSequentialOne) {
    startPausedRun({"--law", "continuous", "--resolver", "threads", "--json", file("run.json")});
    screen_->press("l");
    screen_->press("period");
    ASSERT_TRUE(titleHas("step 1,"));
    close();
    const Json summary = parseJson(contentOf(path("run.json")));
    EXPECT_EQ(summary["law"], "baseline");
    EXPECT_EQ(summary["resolver"], "sequential");
    EXPECT_EQ(summary["requested_resolver"], "threads");
}

/// What cannot be run is refused, and the run goes on as it was.
TEST_F(WindowSwitch, ALawThatCannotRunIsRefused) {
    // The law 'continuous' needs a partition that misses no pair.
    start({"--scene", "imbalanced", "--entities", "50", "--law", "impulse", "--rebuild", "every:10",
           "--paused", "--json", file("run.json")});
    ASSERT_TRUE(titleHas("step 0, paused")) << program_->err();
    screen_->focus();
    screen_->press("l");
    screen_->press("period");
    ASSERT_TRUE(titleHas("step 1,"));
    close();
    EXPECT_EQ(parseJson(contentOf(path("run.json")))["law"], "impulse");
}

TEST_F(WindowSwitch, ResetStartsTheSceneAnewWithThePartitionerOfNow) {
    startPausedRun({"--json", file("run.json"), "--csv", file("frames.csv")});
    screen_->press("2");
    for (int i = 0; i < 4; ++i) screen_->press("period");
    ASSERT_TRUE(titleHas("step 4,"));
    screen_->press("r");
    ASSERT_TRUE(titleHas("step 0,"));
    for (int i = 0; i < 2; ++i) screen_->press("period");
    ASSERT_TRUE(titleHas("step 2,"));
    close();
    const Json summary = parseJson(contentOf(path("run.json")));
    EXPECT_EQ(summary["frames"], 2);
    EXPECT_EQ(summary["partitioner"], "static-grid");
    EXPECT_EQ(summary["state_hash"], summaryOf(scene_ + Arguments{"--frames", "2"})["state_hash"]);
    EXPECT_EQ(parseTable(contentOf(path("frames.csv"))).rows.size(), 2u);
}

}  // namespace
}  // namespace quadrille
