#include "window_run.hpp"

#include <algorithm>
#include <cmath>

namespace quadrille {

void WindowTest::SetUp() {
    screen_ = Screen::start(width, height);
    if (!screen_) GTEST_SKIP() << "there is no Xvfb to open a window on";
}

void WindowTest::start(const Arguments& arguments) {
    const std::string folder = path(".").string();
    program_ = std::make_unique<Process>(
        "/usr/bin/env",
        Arguments{"--chdir=" + folder, "-u", "WAYLAND_DISPLAY", "-u", "SDL_VIDEODRIVER",
                  "DISPLAY=" + screen_->name(), "LIBGL_ALWAYS_SOFTWARE=1", QUADRILLE_PROGRAM} +
            arguments);
}

void WindowTest::startPaused(const std::string& scene, const Arguments& arguments) {
    start(Arguments{"--scene", scene, "--paused"} + arguments);
    ASSERT_TRUE(titleHas("paused")) << program_->err();
    // The title is set before the picture is shown.
    ASSERT_TRUE(shows(panelWidth + 3, 3, background)) << screen_->pixel(panelWidth + 3, 3);
    screen_->focus();
}

bool WindowTest::titleHas(const std::string& part) {
    return eventually([&] {
        // Also takes what the program prints, so that it never waits for a reader.
        if (!program_->waitUntil([&] { return contains(screen_->title(), part); },
                                 Process::Seconds(0.1))) {
            return false;
        }
        return true;
    });
}

bool WindowTest::shows(int x, int y, const Rgb& color) {
    return eventually([&] { return near(screen_->pixel(x, y), color); });
}

WindowTest::Place WindowTest::placeOf(double worldWidth, double worldHeight, double x, double y) {
    constexpr double margin = 1.02;
    const double viewWidth = width - panelWidth, viewHeight = height - timelineHeight;
    const double zoom =
        std::min(viewWidth / (worldWidth * margin), viewHeight / (worldHeight * margin));
    return {int(std::floor(panelWidth + viewWidth / 2 + x * zoom)),
            int(std::floor(viewHeight / 2 - y * zoom))};
}

ProcessResult WindowTest::close() {
    screen_->close();
    ProcessResult result = program_->finish();
    EXPECT_FALSE(result.timedOut);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return result;
}

}  // namespace quadrille
