#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace quadrille::app {

/// What the colour of a body stands for.
enum class ColorBy : std::uint8_t { Entity, Speed, Cell };

/// What is drawn beside the bodies.
struct Overlays {
    bool gridlines = false;
    bool heatMap = false;
    bool contacts = false;
    bool trails = false;  ///< where bodies were in the last seconds
};

/// The part of the command line that concerns the window.
struct WindowOptions {
    bool offscreen = false;          ///< the same pictures, without a screen
    int width = 1280, height = 720;  ///< points
    bool panels = true;
    bool paused = false;
    /// Seconds of the simulation per second; 0 for a step in every picture.
    std::optional<double> speed;
    bool vsync = true;
    Overlays overlays;
    ColorBy colorBy = ColorBy::Entity;
    std::string screenshot;               ///< file name, or empty
    std::uint64_t history = 256'000'000;  ///< bytes for states to go back to; 0: none are kept
};

/// Adds the options of the group "Window".
void declareWindowOptions(CLI::App& app, WindowOptions& options);

}  // namespace quadrille::app
