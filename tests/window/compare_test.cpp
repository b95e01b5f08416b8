// --compare in the window: two views of one time.

#include <cstdlib>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include "app/window/comparison_layout.hpp"
#include "window_run.hpp"

namespace quadrille {
namespace {

/// A square meets a wall that is thinner than its step, beside one that stands still. Of the laws,
/// one lets it through: after 3 steps it is at 60 px, and where it should be, at -80.
constexpr const char* thinWall = R"(
format = 1
name = "thin-wall"
[world]
size = [240, 200]
[step]
dt = 0.015625
[[body]]
position = [-60, 0]
size = [20, 20]
velocity = [2560, 0]
[[body]]
position = [0, -60]
size = [20, 20]
[[body]]
position = [0, 20]
size = [0.1, 80]
static = true
color = "#00ff00"
)";

constexpr Rgb right = fillOf({0x6f, 0x8f, 0xb0}), wrong = fillOf({0xff, 0x50, 0x42});

class WindowCompare : public WindowTest {
  protected:
    void startComparison(const Arguments& more = {}) {
        start(Arguments{"--scene", write("thin-wall.toml", thinWall), "--compare",
                        "impulse,continuous", "--hide-panels", "--paused"} +
              more);
        ASSERT_TRUE(titleHas("step 0, paused")) << program_->err();
        screen_->focus();
    }

    /// Where a place of the world is shown, in the view of one of the runs.
    static Place in(std::size_t run, double x, double y) {
        const app::ComparisonLayout layout =
            app::layOutComparison({0, 0, width, height}, {240, 200}, 1);
        app::Camera camera;
        camera.fit({Vec2(-120, -100), Vec2(120, 100)}, layout.views[run]);
        const Vec2 place = camera.toScreen(Vec2(x, y), layout.views[run]);
        return {int(place.x()), int(place.y())};
    }
    bool showsIn(std::size_t run, double x, double y, const Rgb& color) {
        const Place place = in(run, x, y);
        return shows(place.x, place.y, color);
    }
};

TEST_F(WindowCompare, BodiesWhoseVelocityDiffersAreRedInBothViews) {
    startComparison();
    for (const std::size_t run : {0u, 1u}) {
        EXPECT_TRUE(showsIn(run, -60, 0, right)) << run;
        EXPECT_TRUE(showsIn(run, 0, -60, right)) << run;
    }
    for (int i = 0; i < 3; ++i) screen_->press("period");
    ASSERT_TRUE(titleHas("step 3,"));
    EXPECT_TRUE(showsIn(0, 60, 0, wrong));
    EXPECT_TRUE(showsIn(0, -80, 0, background));
    EXPECT_TRUE(showsIn(1, -80, 0, wrong));
    EXPECT_TRUE(showsIn(1, 60, 0, background));
    for (const std::size_t run : {0u, 1u}) EXPECT_TRUE(showsIn(run, 0, -60, right)) << run;
    close();
}

TEST_F(WindowCompare, SaysWhatARunWithoutAWindowSays) {
    const Arguments run = {"--scene", "echo",        "--frames",
                           "40",      "--compare",   "impulse,continuous",
                           "--set",   "step.dt=0.05"};
    start(run + Arguments{"--speed", "max", "--json", file("run.json"), "--csv", file("a.csv"),
                          "--screenshot", file("a.png")});
    const ProcessResult result = program_->finish();
    ASSERT_EQ(result.exitCode, 0) << result.err;
    Json window = parseJson(contentOf(path("run.json")))["comparison"];
    Json headless = summaryOf(run)["comparison"];
    EXPECT_GT(window["wrong_bodies"], 0);
    EXPECT_EQ(window["beside"]["state_hash"], headless["beside"]["state_hash"]);
    window.erase("beside");
    headless.erase("beside");
    EXPECT_EQ(window, headless);
    EXPECT_EQ(parseTable(contentOf(path("a.csv"))).rows.size(), 40u);
    EXPECT_EQ(readPng(path("a.png")).width, width);
}

/// Both views move together, whichever of them the mouse is over.
TEST_F(WindowCompare, TheViewsHaveOneCamera) {
    startComparison();
    const Place from = in(1, 0, -60), to = in(1, 40, -60);
    screen_->drag(from.x, from.y, to.x, to.y);
    for (const std::size_t run : {0u, 1u}) {
        EXPECT_TRUE(showsIn(run, 40, -60, right)) << run;
        EXPECT_TRUE(showsIn(run, -20, 0, right)) << run;
    }
    close();
}

TEST_F(WindowCompare, AClickSelectsTheBodyInBothViews) {
    startComparison();
    for (int i = 0; i < 3; ++i) screen_->press("period");
    ASSERT_TRUE(titleHas("step 3,"));
    const Place place = in(1, -80, 0);  // it is somewhere else in the first view
    screen_->click(place.x, place.y);
    const auto framed = [&](const Place& edge) {
        constexpr Rgb selection{255, 235, 130};
        return eventually([&] {
            const Image image = screen_->image();
            bool found = false;
            for (int x = edge.x; x < edge.x + 5; ++x) {
                found |= near(image.at(x, edge.y - 15), selection, 60);
            }
            return found;
        });
    };
    EXPECT_TRUE(framed(in(0, 70, 0)));
    EXPECT_TRUE(framed(in(1, -70, 0)));
    close();
}

TEST_F(WindowCompare, APictureIsOfATimeThatBothHaveReached) {
    start({"--scene", write("thin-wall.toml", thinWall), "--compare", "dt=1/256,1/64", "--paused",
           "--csv", file("a.csv")});
    ASSERT_TRUE(titleHas("step 0, paused")) << program_->err();
    screen_->focus();
    screen_->press("period");
    ASSERT_TRUE(titleHas("step 4,"));
    screen_->press("period");
    ASSERT_TRUE(titleHas("step 8,"));
    close();
    EXPECT_EQ(parseTable(contentOf(path("a.csv"))).rows.size(), 2u);
}

TEST_F(WindowCompare, TheRunsStayAsTheyAreAndStartAnewTogether) {
    startComparison({"--json", file("run.json")});
    for (const char* key : {"period", "period", "period", "l", "2", "t"}) screen_->press(key);
    ASSERT_TRUE(titleHas("step 3,"));
    screen_->press("r");
    ASSERT_TRUE(titleHas("step 0,"));
    EXPECT_TRUE(showsIn(0, -60, 0, right));
    EXPECT_TRUE(showsIn(1, -60, 0, right));
    screen_->press("period");
    ASSERT_TRUE(titleHas("step 1,"));
    close();
    const Json summary = parseJson(contentOf(path("run.json")));
    EXPECT_EQ(summary["law"], "impulse");
    EXPECT_EQ(summary["partitioner"], "semi-static-quadtree");
    EXPECT_EQ(summary["comparison"]["beside"]["law"], "continuous");
    EXPECT_EQ(summary["comparison"]["frame"], 1);
}

/// The plots stand at the bottom of the picture: their lines go from left to right.
TEST_F(WindowCompare, PlotsShowBothRunsOverTime) {
    startComparison();
    const app::ScreenRect strip = app::layOutComparison({0, 0, width, height}, {240, 200}, 1).strip;
    // Beside the lines, which are orange and blue, all is grey below the words.
    const auto coloured = [&](int plot) {
        const Image image = screen_->image();
        const int from = int(strip.x + plot * strip.width / 4);
        int pixels = 0;
        for (int y = int(strip.y) + 34; y < height; ++y) {
            for (int x = from; x < from + int(strip.width) / 4; ++x) {
                pixels += std::abs(image.at(x, y).r - image.at(x, y).b) > 60;
            }
        }
        return pixels;
    };
    EXPECT_EQ(coloured(0), 0);
    for (int i = 0; i < 6; ++i) screen_->press("period");
    ASSERT_TRUE(titleHas("step 6,"));
    for (int plot = 0; plot < 4; ++plot) {
        EXPECT_TRUE(eventually([&] { return coloured(plot) > 200; })) << plot;
    }
    close();
}

}  // namespace
}  // namespace quadrille
