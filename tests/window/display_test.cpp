#include <cmath>
#include <gtest/gtest.h>
#include <string>

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
    screen_->press("v");  // by energy: 2048 of the 5000 at which the scale ends
    EXPECT_TRUE(shows(fast.x, fast.y, fillOf({64, 142, 178})));
    EXPECT_TRUE(near(screen_->pixel(slow.x, slow.y), fillOf({52, 62, 120})));
    screen_->press("v");  // by the time since the last hit: nobody was hit
    EXPECT_TRUE(shows(fast.x, fast.y, fillOf({82, 62, 140})));
    screen_->press("v");  // by cell: there are none before the first step
    EXPECT_TRUE(shows(slow.x, slow.y, red));
    screen_->press("period");
    EXPECT_TRUE(eventually([&] { return !near(screen_->pixel(slow.x, slow.y), red, 40); }));
    screen_->press("v");
    EXPECT_TRUE(shows(slow.x, slow.y, red));
    close();
}

/// A box of 4 kg that runs into another at 64 px/s, along x.
constexpr const char* touchScene = R"(
format = 1
name = "touch"
[world]
size = [200, 100]
[step]
dt = 0.015625
[[body]]
position = [-10.25, 0]
size = [20, 20]
mass = 4
velocity = [64, 0]
color = "#ff0000"
[[body]]
position = [10.25, 0]
size = [20, 20]
mass = 4
color = "#00ff00"
[[body]]
position = [-60, -30]
size = [20, 20]
color = "#0000ff"
)";

/// How far a colour reaches from a place to the right, points.
int reachOf(const Image& image, int x, int y, const Rgb& color) {
    int reach = 0;
    while (near(image.at(x + reach, y), color, 12)) ++reach;
    return reach;
}

TEST_F(WindowDisplay, ContactsAreMarkedWithTheirAxisAndImpulse) {
    startPaused(write("touch.toml", touchScene), {"--show", "contacts"});
    constexpr Rgb collided{255, 120, 80};
    const Place between = place(0.5, 0), side = place(0.5, 8);
    ASSERT_TRUE(shows(place(0, 0).x, place(0, 0).y, background));
    screen_->press("period");
    ASSERT_TRUE(shows(between.x, between.y, collided));
    const Image image = screen_->image();
    // The line of the impulse lies along x, that of the sides along y.
    EXPECT_GT(reachOf(image, between.x, between.y, collided), 12);
    EXPECT_TRUE(near(image.at(side.x, side.y), collided, 12)) << image.at(side.x, side.y);
    EXPECT_LT(reachOf(image, side.x, side.y, collided), 5);
    // At another zoom, too.
    for (int i = 0; i < 14; ++i) screen_->press("Next");
    screen_->press("Home");
    EXPECT_TRUE(shows(between.x, between.y, collided));
    screen_->press("c");
    EXPECT_TRUE(
        eventually([&] { return !near(screen_->pixel(between.x, between.y), collided, 12); }));
    close();
}

TEST_F(WindowDisplay, ArrowsShowVelocities) {
    startPaused(write("still.toml", stillScene));
    constexpr Rgb arrow{190, 230, 255};
    const Place mover = place(0, 0), still = place(-60, 30);
    ASSERT_TRUE(shows(mover.x + 3, mover.y, fillOf({255, 0, 255})));
    screen_->press("a");
    ASSERT_TRUE(shows(mover.x + 3, mover.y, arrow));
    const Image image = screen_->image();
    // To the right, 64 of the 100 px/s that 44 points stand for; what stands still has none.
    EXPECT_NEAR(reachOf(image, mover.x + 3, mover.y, arrow), 44 * 0.64 - 3, 3);
    EXPECT_TRUE(near(image.at(mover.x - 4, mover.y), fillOf({255, 0, 255}), 40));
    EXPECT_TRUE(near(image.at(still.x, still.y), red));
    screen_->press("a");
    EXPECT_TRUE(shows(mover.x + 3, mover.y, fillOf({255, 0, 255})));
    close();
}

TEST_F(WindowDisplay, ColoursFollowTheTimeSinceTheLastHit) {
    startPaused(write("touch.toml", touchScene), {"--color-by", "since-hit"});
    const Place hit = place(16, 0), never = place(-60, -30);
    ASSERT_TRUE(shows(hit.x, hit.y, fillOf({82, 62, 140})));
    screen_->press("period");
    // The scale ends at 10 ms: it was hit half of a step ago.
    EXPECT_TRUE(eventually([&] {
        return near(screen_->pixel(hit.x, hit.y), fillOf({146, 54, 154}), 6);
    })) << screen_->pixel(hit.x, hit.y);
    EXPECT_TRUE(near(screen_->pixel(never.x, never.y), fillOf({82, 62, 140})));
    close();
}

/// The legend stands in the lower right corner, and shows the colours of the scale.
TEST_F(WindowDisplay, ColourScalesHaveLegends) {
    startPaused(write("still.toml", stillScene));
    // From the yellow end of a scale to its dark one, somewhere on one line.
    const auto hasScale = [&](const Rgb& first, const Rgb& last) {
        const Image image = screen_->image();
        for (int y = height - 160; y < height; ++y) {
            int from = 0, to = 0;
            for (int x = width - 240; x < width; ++x) {
                if (near(image.at(x, y), first, 8) && from == 0) from = x;
                if (near(image.at(x, y), last, 8)) to = x;
            }
            if (from > 0 && to > from + 100) return true;
        }
        return false;
    };
    EXPECT_FALSE(hasScale({72, 62, 160}, {253, 231, 37}));
    screen_->press("v");
    EXPECT_TRUE(eventually([&] { return hasScale({72, 62, 160}, {253, 231, 37}); }));
    screen_->press("v");
    EXPECT_TRUE(eventually([&] { return hasScale({52, 62, 120}, {255, 252, 204}); }));
    screen_->press("v");
    EXPECT_TRUE(eventually([&] { return hasScale({240, 249, 33}, {82, 62, 140}); }));
    screen_->press("m");
    EXPECT_TRUE(eventually([&] { return hasScale({31, 12, 72}, {247, 209, 61}); }));
    EXPECT_TRUE(hasScale({240, 249, 33}, {82, 62, 140}));
    close();
}

/// A box covers as much of the pixels around it as it is large.
TEST_F(WindowDisplay, SmallBoxesKeepTheirShareOfAPixel) {
    std::string scene = "format = 1\nname = \"small\"\n[world]\nsize = [2000, 1000]\n";
    const auto body = [&](double x, double side) {
        scene += "[[body]]\nposition = [" + std::to_string(x) + ", 0]\nsize = [" +
                 std::to_string(side) + ", " + std::to_string(side) + "]\ncolor = \"#ffffff\"\n";
    };
    body(-600, 1.4);  // points: 0.67
    body(0, 4);       // 1.9
    body(600, 7);     // 3.4
    startPaused(write("small.toml", scene));
    const Image image = screen_->image();
    const double zoom = (width - panelWidth) / (2000 * 1.02);
    const auto lightAt = [&](double x) {
        const Place p = placeOf(2000, 1000, x, 0);
        double sum = 0;
        for (int dx = -6; dx <= 6; ++dx) {
            for (int dy = -6; dy <= 6; ++dy) {
                sum += double(image.at(p.x + dx, p.y + dy).r - background.r) / (255 - background.r);
            }
        }
        return sum;
    };
    EXPECT_NEAR(lightAt(-600), std::pow(1.4 * zoom, 2), 0.1);
    EXPECT_NEAR(lightAt(0), std::pow(4 * zoom, 2), 0.3);
    EXPECT_NEAR(lightAt(600), std::pow(7 * zoom, 2), 0.7);
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
