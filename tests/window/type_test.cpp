#include <gtest/gtest.h>

#include "scenes.hpp"
#include "window_run.hpp"

namespace quadrille {
namespace {

/// Text, lists, the size of it all, and what closes them.
class WindowType : public WindowTest {
  protected:
    /// Where the world begins: its lowest rows are empty.
    static int panelWidthOf(const Image& image) {
        int x = image.width;
        while (x > 0 && near(image.at(x - 1, 3), background)) --x;
        return x;
    }

    int changed(const Image& before, int left) {
        const Image now = screen_->image();
        int count = 0;
        for (int y = 0; y < now.height; ++y) {
            for (int x = left; x < now.width; ++x) {
                count += !near(before.at(x, y), now.at(x, y), 8);
            }
        }
        return count;
    }
};

/// The list of partitioners: its closed field is some 100 points below the top.
TEST_F(WindowType, EscClosesAnOpenListFirst) {
    startPaused(write("still.toml", stillScene));
    const Place body = placeOf(stillWidth, stillHeight, 60, 30);
    screen_->click(body.x, body.y);
    ASSERT_TRUE(eventually([&] { return !near(screen_->pixel(width - 30, 40), background); }));
    screen_->moveMouse(700, 600);
    const Image before = screen_->image();
    screen_->click(100, 104);
    const auto listIsOpen = [&](bool open) {
        return eventually([&] {
            const Image now = screen_->image();
            int count = 0;
            for (int y = 118; y < 190; ++y) {
                for (int x = 20; x < 180; ++x) count += !near(before.at(x, y), now.at(x, y), 8);
            }
            return (count > 3000) == open;
        });
    };
    ASSERT_TRUE(listIsOpen(true));
    screen_->press("Escape");
    EXPECT_TRUE(listIsOpen(false));
    EXPECT_FALSE(near(screen_->pixel(width - 30, 40), background)) << "the selection went, too";
    screen_->press("Escape");
    EXPECT_TRUE(eventually([&] { return near(screen_->pixel(width - 30, 40), background); }));
    close();
}

TEST_F(WindowType, ControlsAndPlotsExplainThemselves) {
    startPaused(write("still.toml", stillScene));
    screen_->moveMouse(700, 600);
    const Image before = screen_->image();
    // A tooltip of the reset button reaches into the world.
    screen_->moveMouse(290, 38);
    EXPECT_TRUE(eventually([&] { return changed(before, panelWidth) > 1500; }));
    screen_->moveMouse(700, 600);
    EXPECT_TRUE(eventually([&] { return changed(before, panelWidth) == 0; }));
    close();
}

TEST_F(WindowType, TheFrameTimePlotTellsWhatIsUnderTheMouse) {
    // Low enough for all of the column.
    // So high that the column needs no scrolling.
    screen_ = Screen::start(width, 1200);
    ASSERT_TRUE(screen_);
    startPaused(write("still.toml", stillScene), {"--size", "1280,1200"});
    for (int i = 0; i < 5; ++i) screen_->press("period");
    screen_->moveMouse(700, 1000);
    ASSERT_TRUE(titleHas("step 5,"));
    screen_->press("Tab");  // what is shown after it is of step 5
    ASSERT_TRUE(shows(20, 14, background));
    screen_->press("Tab");
    ASSERT_TRUE(eventually([&] { return !near(screen_->pixel(20, 14), background); }));
    const Image before = screen_->image();
    screen_->moveMouse(295, 760);
    EXPECT_TRUE(eventually([&] { return changed(before, panelWidth) > 5000; }));
    close();
}

TEST_F(WindowType, ScaleIsThatOfTheDisplayUnlessAskedFor) {
    start({"--scene", write("still.toml", stillScene), "--paused", "--scale", "1.5"});
    ASSERT_TRUE(titleHas("paused")) << program_->err();
    EXPECT_TRUE(eventually([&] { return panelWidthOf(screen_->image()) == panelWidth * 3 / 2; }));
    close();
    screen_->wantDotsPerInch(192);
    start({"--scene", write("still.toml", stillScene), "--paused"});
    ASSERT_TRUE(titleHas("paused")) << program_->err();
    EXPECT_TRUE(eventually([&] { return panelWidthOf(screen_->image()) == panelWidth * 2; }));
    screen_->focus();
    screen_->press("Tab");
    EXPECT_TRUE(eventually([&] { return panelWidthOf(screen_->image()) == 0; }));
    close();
}

TEST_F(WindowType, F11AsksForTheScreenAndEscForAWindowAgain) {
    startPaused(write("still.toml", stillScene));
    EXPECT_TRUE(screen_->asksForFullScreen("F11", true));
    EXPECT_TRUE(screen_->asksForFullScreen("Escape", false));
    close();
}

}  // namespace
}  // namespace quadrille
