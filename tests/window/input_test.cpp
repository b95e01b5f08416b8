#include <gtest/gtest.h>
#include <string>

#include "scenes.hpp"
#include "window_run.hpp"

namespace quadrille {
namespace {

constexpr Rgb red = fillOf({255, 0, 0}), green = fillOf({0, 255, 0});

class WindowInput : public WindowTest {
  protected:
    Place place(double x, double y) const { return placeOf(stillWidth, stillHeight, x, y); }

    /// Whether the window of the selected entity stands at the top right.
    bool entityWindow(bool there) {
        return eventually(
            [&] { return near(screen_->pixel(width - 30, 40), background) != there; });
    }
};

TEST_F(WindowInput, KeysStepPauseAndReset) {
    startPaused(write("still.toml", stillScene));
    ASSERT_TRUE(titleHas("still, step 0, paused"));
    screen_->press("period");
    EXPECT_TRUE(titleHas("step 1, paused"));
    screen_->press("n");
    EXPECT_TRUE(titleHas("step 2, paused"));
    screen_->press("r");
    EXPECT_TRUE(titleHas("step 0, paused"));
    screen_->press("space");
    EXPECT_TRUE(eventually([&] {
        const std::string title = screen_->title();
        return !contains(title, "paused") && !contains(title, "step 0");
    }));
    screen_->press("space");
    EXPECT_TRUE(titleHas("paused"));
    close();
}

TEST_F(WindowInput, AClickSelectsABodyAndShowsItsComponents) {
    startPaused(write("still.toml", stillScene));
    const Place body = place(60, 30), nothing = place(0, 40);
    EXPECT_TRUE(entityWindow(false));
    screen_->click(body.x, body.y);
    EXPECT_TRUE(entityWindow(true));
    screen_->click(nothing.x, nothing.y);
    EXPECT_TRUE(entityWindow(false));
    screen_->click(body.x, body.y);
    EXPECT_TRUE(entityWindow(true));
    screen_->press("Escape");
    EXPECT_TRUE(entityWindow(false));
    close();
}

TEST_F(WindowInput, FollowKeepsTheSelectedBodyInTheMiddle) {
    startPaused(write("still.toml", stillScene));
    const Place mover = place(0, 0), still = place(-60, 30);
    screen_->click(mover.x, mover.y);
    ASSERT_TRUE(entityWindow(true));
    screen_->press("f");
    for (int i = 0; i < 10; ++i) screen_->press("period");  // each moves it by 1 px
    ASSERT_TRUE(titleHas("step 10,"));
    const Place moved = place(-70, 30);
    EXPECT_TRUE(shows(mover.x - 10, mover.y, fillOf({255, 0, 255})));
    EXPECT_TRUE(shows(moved.x, moved.y, red));
    EXPECT_TRUE(near(screen_->pixel(still.x + 1, still.y), red) ||
                near(screen_->pixel(still.x + 1, still.y), background));
    close();
}

TEST_F(WindowInput, TheWheelZoomsToTheCursor) {
    startPaused(write("still.toml", stillScene));
    const Place middle = place(60, 30), outside = place(60, 42);
    ASSERT_TRUE(shows(outside.x, outside.y, background));
    screen_->wheel(middle.x, middle.y, 4);
    EXPECT_TRUE(shows(outside.x, outside.y, green));
    EXPECT_TRUE(near(screen_->pixel(middle.x, middle.y), green));
    screen_->wheel(middle.x, middle.y, -4);
    EXPECT_TRUE(shows(outside.x, outside.y, background));
    screen_->press("Home");
    EXPECT_TRUE(shows(middle.x, middle.y, green));
    close();
}

TEST_F(WindowInput, DraggingPansAndDoesNotSelect) {
    startPaused(write("still.toml", stillScene));
    const Place body = place(-60, 30);
    screen_->drag(body.x, body.y, body.x + 150, body.y + 80);
    EXPECT_TRUE(shows(body.x + 150, body.y + 80, red));
    EXPECT_TRUE(shows(body.x, body.y, background));
    EXPECT_TRUE(entityWindow(false));
    screen_->press("Home");
    EXPECT_TRUE(shows(body.x, body.y, red));
    close();
}

TEST_F(WindowInput, PanelsKeepTheMouseThatTheyUse) {
    startPaused(write("still.toml", stillScene));
    const Place body = place(-60, 30);
    screen_->click(body.x, body.y);
    ASSERT_TRUE(entityWindow(true));
    // Over the column: neither a click on nothing, nor a zoom, nor a drag of the world.
    screen_->click(150, 700);
    screen_->wheel(150, 700, 5);
    screen_->drag(150, 700, 600, 300);
    // A key is handled after them, and shows that they are through.
    screen_->press("period");
    ASSERT_TRUE(titleHas("step 1,"));
    EXPECT_TRUE(entityWindow(true));
    EXPECT_TRUE(shows(body.x, body.y, red));
    // The step button works, and the entity's window keeps the wheel, too.
    screen_->click(150, 36);
    EXPECT_TRUE(titleHas("step 2,"));
    screen_->wheel(width - 100, 60, 5);
    screen_->click(150, 36);
    ASSERT_TRUE(titleHas("step 3,"));
    EXPECT_TRUE(shows(body.x, body.y, red));
    close();
}

TEST_F(WindowInput, HelpOpensAndCloses) {
    startPaused(write("still.toml", stillScene));
    const int x = width / 2 - 40, y = height / 2 + 100;
    ASSERT_TRUE(shows(x, y, background));
    screen_->press("F1");
    EXPECT_TRUE(eventually([&] { return !near(screen_->pixel(x, y), background); }));
    screen_->press("Escape");
    EXPECT_TRUE(shows(x, y, background));
    close();
}

TEST_F(WindowInput, EscClosesTheInnermostThingFirst) {
    startPaused(write("still.toml", stillScene));
    const Place body = place(60, 30);
    const int x = width / 2 - 40, y = height / 2 + 100;
    screen_->click(body.x, body.y);
    ASSERT_TRUE(entityWindow(true));
    screen_->press("F1");
    ASSERT_TRUE(eventually([&] { return !near(screen_->pixel(x, y), background); }));
    screen_->press("Escape");
    EXPECT_TRUE(shows(x, y, background));
    EXPECT_TRUE(entityWindow(true));
    screen_->press("Escape");
    EXPECT_TRUE(entityWindow(false));
    close();
}

TEST_F(WindowInput, TheScreenshotKeyWritesAFile) {
    startPaused(write("still.toml", stillScene));
    screen_->press("period");
    ASSERT_TRUE(titleHas("step 1,"));
    screen_->press("F12");
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(path("still-1.png")); }));
    const Image image = readPng(path("still-1.png"));
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    const Place body = place(-60, 30);
    EXPECT_TRUE(near(image.at(body.x, body.y), red));
    close();
}

TEST_F(WindowInput, ADroppedSceneIsOpened) {
    startPaused(write("still.toml", stillScene));
    const std::string bad = write("bad.toml", "format = 7");
    ASSERT_TRUE(screen_->drop(bad));
    screen_->press("period");  // the old run goes on
    EXPECT_TRUE(titleHas("still, step 1,"));
    const std::string other = write("other.toml",
                                    "format = 1\nname = \"other\"\n[world]\nsize = [200, 100]\n"
                                    "[[body]]\nposition = [0, 0]\nsize = [50, 50]\n"
                                    "color = \"#00ff00\"\n");
    ASSERT_TRUE(screen_->drop(other));
    EXPECT_TRUE(titleHas("other, step 0"));
    const Place body = place(20, 20);
    EXPECT_TRUE(shows(body.x, body.y, green));
    close();
}

}  // namespace
}  // namespace quadrille
