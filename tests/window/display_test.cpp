#include <gtest/gtest.h>

#include "scenes.hpp"
#include "window_run.hpp"

namespace quadrille {
namespace {

constexpr Rgb red = fillOf({255, 0, 0}), green = fillOf({0, 255, 0}), blue = fillOf({0, 0, 255}),
              yellow = fillOf({255, 255, 0});

class WindowDisplay : public WindowTest {
  protected:
    Place place(double x, double y) const { return placeOf(stillWidth, stillHeight, x, y); }
};

TEST_F(WindowDisplay, BodiesStandWhereTheyAreInTheirColours) {
    const std::string scene = write("still.toml", stillScene);
    startPaused(scene, {"--screenshot", file("a.png")});
    const auto check = [&](const Image& image) {
        const auto at = [&](double x, double y) {
            const Place p = place(x, y);
            return image.at(p.x, p.y);
        };
        EXPECT_TRUE(near(at(-60, 30), red)) << at(-60, 30);
        EXPECT_TRUE(near(at(60, 30), green)) << at(60, 30);
        EXPECT_TRUE(near(at(60, -30), blue)) << at(60, -30);
        EXPECT_TRUE(near(at(-60, -30), yellow)) << at(-60, -30);
        // Just inside and just outside of the edges, on every side.
        for (const double side : {-1.0, 1.0}) {
            EXPECT_TRUE(near(at(60 + side * 14.5, -30), blue)) << at(60 + side * 14.5, -30);
            EXPECT_TRUE(near(at(60, -30 + side * 4.5), blue)) << at(60, -30 + side * 4.5);
            EXPECT_TRUE(near(at(60 + side * 15.5, -30), background));
            EXPECT_TRUE(near(at(60, -30 + side * 5.5), background));
        }
        EXPECT_TRUE(near(at(0, 30), background));
    };
    check(screen_->image());
    close();
    check(readPng(path("a.png")));
}

/// Two boxes that overlap by 10 px, two that touch, one that stands 5 px deep in a static one, and
/// two static ones that overlap.
TEST_F(WindowDisplay, BoxesHaveOutlinesAndOverlapsAreMarked) {
    std::string scene = "format = 1\nname = \"overlap\"\n[world]\nsize = [200, 100]\n";
    const auto body = [&](double x, double y, const char* more = "") {
        scene += "[[body]]\nposition = [" + std::to_string(x) + ", " + std::to_string(y) +
                 "]\nsize = [20, 20]\ncolor = \"#00ff00\"\n" + more;
    };
    body(-60, 30);
    body(-50, 30);
    body(-60, -30);
    body(-40, -30);
    body(40, 30, "static = true\n");
    body(55, 30);
    body(40, -30, "static = true\n");
    body(50, -30, "static = true\n");
    startPaused(write("overlap.toml", scene), {"--hide-panels"});
    // Without the panels the world fills the window.
    const double zoom = std::min(width / (200 * 1.02), height / (100 * 1.02));
    const auto at = [&](const Image& image, double x, double y) {
        return image.at(int(width / 2.0 + x * zoom), int(height / 2.0 - y * zoom));
    };
    const auto marked = [](const Rgb& c) { return c.r > 150 && c.g < 140; };
    const auto brightest = [&](const Image& image, double x, double y) {
        int most = 0;
        for (int d = -2; d <= 2; ++d) most = std::max(most, at(image, x + d / zoom, y).g);
        return most;
    };
    Image image = screen_->image();
    EXPECT_TRUE(near(at(image, -65, 30), green)) << at(image, -65, 30);
    EXPECT_GT(brightest(image, -70, 30), 180);
    EXPECT_TRUE(marked(at(image, -55, 30))) << at(image, -55, 30);
    for (const double x : {-51.0, -50.2, -49.8, -49.0}) {
        EXPECT_FALSE(marked(at(image, x, -30))) << x << at(image, x, -30);
    }
    EXPECT_TRUE(marked(at(image, 47.5, 30))) << at(image, 47.5, 30);
    EXPECT_FALSE(marked(at(image, 45, -30))) << at(image, 45, -30);
    // Too small for an outline, boxes are filled, and nothing is marked.
    for (int i = 0; i < 16; ++i) screen_->press("Next");
    const auto small = [&] {
        image = screen_->image();
        for (const Rgb& c : image.pixels) {
            if (marked(c)) return false;
        }
        return true;
    };
    EXPECT_TRUE(eventually(small));
    close();
}

TEST_F(WindowDisplay, GridlinesRunBetweenTheCells) {
    startPaused(write("still.toml", stillScene),
                {"--partitioner", "static-grid", "--cell-size", "50,50"});
    screen_->press("period");  // cells are made by a step
    ASSERT_TRUE(titleHas("step 1,"));
    const Place middle = place(-25, 25), corner = place(-50, 25), side = place(-75, 0);
    ASSERT_TRUE(shows(middle.x, middle.y, background));
    const auto brightest = [&](int x, int y, bool acrossX) {
        const Image image = screen_->image();
        int most = 0;
        for (int d = -2; d <= 2; ++d) {
            most = std::max(most, acrossX ? image.at(x + d, y).g : image.at(x, y + d).g);
        }
        return most;
    };
    EXPECT_LT(brightest(corner.x, corner.y, true), 40);
    screen_->press("g");
    EXPECT_TRUE(eventually([&] { return brightest(corner.x, corner.y, true) > 60; }));
    EXPECT_TRUE(eventually([&] { return brightest(side.x, side.y, false) > 60; }));
    EXPECT_TRUE(near(screen_->pixel(middle.x, middle.y), background));
    screen_->press("g");
    EXPECT_TRUE(eventually([&] { return brightest(corner.x, corner.y, true) < 40; }));
    close();
}

TEST_F(WindowDisplay, TheHeatMapShowsWhereBodiesAreMany) {
    // A body in one cell of 50 x 50 px, twelve in another.
    std::string scene = "format = 1\nname = \"heat\"\n[world]\nsize = [200, 100]\n";
    const auto body = [&](double x, double y) {
        scene += "[[body]]\nposition = [" + std::to_string(x) + ", " + std::to_string(y) +
                 "]\nsize = [1, 1]\n";
    };
    body(-75, 25);
    for (int i = 0; i < 12; ++i) body(65 + 2 * i, -10);
    startPaused(write("heat.toml", scene),
                {"--partitioner", "static-grid", "--cell-size", "50,50", "--show", "heat-map"});
    screen_->press("period");
    const Place few = place(-60, 40), many = place(60, -40), none = place(-25, 25);
    const auto light = [&](const Place& p) {
        const Rgb c = screen_->pixel(p.x, p.y);
        return c.r + c.g + c.b;
    };
    EXPECT_TRUE(eventually([&] { return light(many) > 400; })) << light(many);
    EXPECT_GT(light(few), light(none) + 20);
    EXPECT_LT(light(few), light(many) - 100);
    EXPECT_TRUE(near(screen_->pixel(none.x, none.y), background));
    close();
}

TEST_F(WindowDisplay, ColoursFollowSpeedAndCell) {
    startPaused(write("still.toml", stillScene));
    const Place slow = place(-60, 30), fast = place(0, 0), wall = place(60, -30);
    ASSERT_TRUE(shows(slow.x, slow.y, red));
    screen_->press("v");  // by speed: the fastest is yellow
    EXPECT_TRUE(shows(fast.x, fast.y, fillOf({253, 231, 37})));
    EXPECT_TRUE(near(screen_->pixel(slow.x, slow.y), fillOf({72, 62, 160})));
    EXPECT_TRUE(near(screen_->pixel(wall.x, wall.y), blue));
    screen_->press("v");  // by cell: there are none before the first step
    EXPECT_TRUE(shows(slow.x, slow.y, red));
    screen_->press("period");
    EXPECT_TRUE(eventually([&] { return !near(screen_->pixel(slow.x, slow.y), red, 40); }));
    screen_->press("v");
    EXPECT_TRUE(shows(slow.x, slow.y, red));
    close();
}

TEST_F(WindowDisplay, ContactsAreMarked) {
    startPaused(write("touch.toml", R"(
format = 1
name = "touch"
[world]
size = [200, 100]
[step]
dt = 0.015625
[[body]]
position = [-10.25, 0]
size = [20, 20]
velocity = [64, 0]
color = "#ff0000"
[[body]]
position = [10.25, 0]
size = [20, 20]
color = "#00ff00"
)"),
                {"--show", "contacts"});
    const Place between = place(0, 0);
    ASSERT_TRUE(shows(between.x, between.y, background));
    screen_->press("period");
    EXPECT_TRUE(shows(between.x, between.y, {255, 120, 80}));
    close();
}

TEST_F(WindowDisplay, ThePictureFollowsTheSizeOfTheWindow) {
    startPaused(write("still.toml", stillScene), {"--screenshot", file("a.png")});
    screen_->resize(900, 500);
    // As wide as the view is now: 600 points for 200 px and a margin.
    const double zoom = 600 / (stillWidth * 1.02);
    const int x = int(600 - 60 * zoom), y = int(250 - 30 * zoom);
    EXPECT_TRUE(shows(x, y, red));
    close();
    const Image image = readPng(path("a.png"));
    EXPECT_EQ(image.width, 900);
    EXPECT_EQ(image.height, 500);
    EXPECT_TRUE(near(image.at(x, y), red));
}

TEST_F(WindowDisplay, PanelsCanBeHidden) {
    startPaused(write("still.toml", stillScene));
    ASSERT_FALSE(near(screen_->pixel(20, 14), background));
    screen_->press("Tab");
    EXPECT_TRUE(shows(20, 14, background));
    screen_->press("Tab");
    EXPECT_TRUE(eventually([&] { return !near(screen_->pixel(20, 14), background); }));
    close();
}

}  // namespace
}  // namespace quadrille
