#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <quadrille/names.hpp>

namespace CLI {
class App;
}

namespace quadrille::app {

/// What the colour of a body stands for.
enum class ColorBy : std::uint8_t { Entity, Speed, Energy, SinceHit, Cell };

/// All that there are, in the order of the list and of the key that goes through them.
std::span<const Named<ColorBy>> colorings();

/// What is drawn beside the bodies.
struct Overlays {
    bool gridlines = false;
    bool heatMap = false;
    bool contacts = false;
    bool arrows = false;  ///< velocities
    bool trails = false;  ///< where bodies were in the last seconds
};

struct WindowSize {
    int width, height;  ///< points
};

/// The part of the command line that concerns the window.
struct WindowOptions {
    bool offscreen = false;  ///< the same pictures, without a screen
    std::optional<WindowSize> size;
    std::optional<double> scale;  ///< of text and panels; otherwise the display's
    bool panels = true;
    bool paused = false;
    /// Seconds of the simulation per second; 0 for a step in every picture.
    std::optional<double> speed;
    bool vsync = true;
    Overlays overlays;
    ColorBy colorBy = ColorBy::Entity;
    std::string screenshot;               ///< file name, or empty
    std::string video;                    ///< file name, or empty
    int frameRate = 60;                   ///< of the video, pictures per second
    std::uint64_t history = 256'000'000;  ///< bytes for states to go back to; 0: none are kept
};

/// Adds the options of the group "Window".
void declareWindowOptions(CLI::App& app, WindowOptions& options);

}  // namespace quadrille::app
