#pragma once

#include <memory>

#include "program.hpp"
#include "screen.hpp"

namespace quadrille {

/// What a box of this colour shows inside of its outline, before the background.
constexpr Rgb fillOf(const Rgb& color) {
    constexpr Rgb background{13, 16, 20};
    const auto mix = [](int from, int to) { return int(from + 0.45 * (to - from) + 0.5); };
    return {mix(background.r, color.r), mix(background.g, color.g), mix(background.b, color.b)};
}

/// Tests of the program in a window on a screen of their own, 1280 x 720 points, which the window
/// fills. They wait for what they expect and never for a time.
class WindowTest : public ProgramTest {
  protected:
    static constexpr int width = 1280, height = 720;
    static constexpr int panelWidth = 320, timelineHeight = 34;
    static constexpr Rgb background{13, 16, 20};

    /// Starts the screen; the test is skipped where there is no Xvfb.
    void SetUp() override;

    /// Starts the program on the screen.
    void start(const Arguments& arguments);
    /// The same, paused, with this scene; returns when it has shown its first picture.
    void startPaused(const std::string& scene, const Arguments& arguments = {});

    bool titleHas(const std::string& part);
    /// Until the pixel has this colour.
    bool shows(int x, int y, const Rgb& color);
    /// Where a place of a world of this size stands on the screen while all of it is shown.
    struct Place {
        int x, y;
    };
    static Place placeOf(double worldWidth, double worldHeight, double x, double y);

    /// Ends the program by its close button, which must succeed.
    ProcessResult close();

    std::unique_ptr<Screen> screen_;
    std::unique_ptr<Process> program_;
};

}  // namespace quadrille
