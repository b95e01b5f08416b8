// The timeline: the past of a run is looked at, and the run is none the worse for it.

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "scenes.hpp"
#include "window_run.hpp"

namespace quadrille {
namespace {

class WindowPast : public WindowTest {
  protected:
    /// Paused, after so many steps.
    void startAt(int steps, const Arguments& more = {}) {
        start(Arguments{"--scene", "echo", "--paused"} + more);
        ASSERT_TRUE(titleHas("step 0, paused")) << program_->err();
        screen_->focus();
        for (int i = 0; i < steps; ++i) screen_->press("period");
        ASSERT_TRUE(titleHas("step " + std::to_string(steps) + ","));
    }

    /// What the world shows, once two pictures in a row are the same.
    std::vector<Rgb> settledWorld() {
        std::vector<Rgb> before;
        std::vector<Rgb> now;
        eventually([&] {
            before = std::move(now);
            now.clear();
            const Image image = screen_->image();
            for (int y = 0; y < height - timelineHeight; ++y) {
                for (int x = panelWidth; x < width; ++x) now.push_back(image.at(x, y));
            }
            return now == before;
        });
        return now;
    }
};

TEST_F(WindowPast, AStepBackShowsThePictureOfThatStep) {
    startAt(5);
    const auto fifth = settledWorld();
    for (int i = 0; i < 7; ++i) screen_->press("period");
    ASSERT_TRUE(titleHas("step 12,"));
    EXPECT_NE(settledWorld(), fifth);
    for (int i = 0; i < 7; ++i) screen_->press("comma");
    ASSERT_TRUE(titleHas("step 5,"));
    EXPECT_EQ(settledWorld(), fifth);
    screen_->press("period");
    ASSERT_TRUE(titleHas("step 6,"));
    close();
}

TEST_F(WindowPast, TheRunGoesOnFromItsNewestStep) {
    startAt(10, {"--json", file("run.json")});
    for (int i = 0; i < 4; ++i) screen_->press("comma");
    ASSERT_TRUE(titleHas("step 6,"));
    screen_->press("End");
    ASSERT_TRUE(titleHas("step 10,"));
    for (int i = 0; i < 2; ++i) screen_->press("comma");
    ASSERT_TRUE(titleHas("step 8,"));
    // Two steps through the past, and three new ones.
    for (int i = 0; i < 5; ++i) screen_->press("period");
    ASSERT_TRUE(titleHas("step 13,"));
    screen_->press("comma");
    ASSERT_TRUE(titleHas("step 12,"));
    close();
    const Json summary = parseJson(contentOf(path("run.json")));
    EXPECT_EQ(summary["frames"], 13);
    EXPECT_EQ(summary["state_hash"],
              summaryOf({"--scene", "echo", "--frames", "13"})["state_hash"]);
}

TEST_F(WindowPast, ItPlaysBackwardsToTheStart) {
    startAt(0);
    const auto first = settledWorld();
    for (int i = 0; i < 20; ++i) screen_->press("period");
    ASSERT_TRUE(titleHas("step 20,"));
    screen_->press("b");
    ASSERT_TRUE(titleHas("step 0, paused"));
    EXPECT_EQ(settledWorld(), first);
    close();
}

TEST_F(WindowPast, TheSliderGoesToAnyStep) {
    startAt(40);
    // From its end to somewhere left of its middle.
    const int y = height - timelineHeight / 2;
    screen_->drag(width - 16, y, 700, y);
    ASSERT_TRUE(eventually([&] {
        const std::string title = screen_->title();
        const std::size_t place = title.find("step ");
        if (place == std::string::npos) return false;
        const int step = std::stoi(title.substr(place + 5));
        return step > 5 && step < 25;
    })) << screen_->title();
    screen_->press("End");
    EXPECT_TRUE(titleHas("step 40,"));
    close();
}

/// A body that moves to the right leaves a line behind it, and none where it will be.
TEST_F(WindowPast, TrailsShowWhereTheSelectedBodyWas) {
    startPaused(write("still.toml", stillScene), {"--show", "trails"});
    for (int i = 0; i < 40; ++i) screen_->press("period");  // 1 px each
    ASSERT_TRUE(titleHas("step 40,"));
    const Place body = placeOf(stillWidth, stillHeight, 40, 0);
    screen_->click(body.x, body.y);
    const auto trailAt = [&](double x) {
        const Place place = placeOf(stillWidth, stillHeight, x, 0);
        const Image image = screen_->image();
        int most = 0;
        for (int dy = -2; dy <= 2; ++dy) most = std::max(most, image.at(place.x, place.y + dy).r);
        return most > 40;
    };
    EXPECT_TRUE(eventually([&] { return trailAt(20); }));
    EXPECT_TRUE(trailAt(3));
    EXPECT_FALSE(trailAt(-10));
    for (int i = 0; i < 30; ++i) screen_->press("comma");
    ASSERT_TRUE(titleHas("step 10,"));
    EXPECT_TRUE(eventually([&] { return trailAt(3) && !trailAt(-10); }));
    screen_->press("w");
    EXPECT_TRUE(eventually([&] { return !trailAt(3); }));
    close();
}

TEST_F(WindowPast, AtItsStartARunDoesNotGoBackwards) {
    startAt(0);
    screen_->press("b");
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_TRUE(titleHas("step 0, paused"));
    close();
}

TEST_F(WindowPast, WithoutMemoryThereIsNone) {
    startAt(3, {"--history", "0"});
    screen_->press("comma");
    screen_->press("b");
    screen_->press("period");
    EXPECT_TRUE(titleHas("step 4,"));
    close();
}

}  // namespace
}  // namespace quadrille
