#pragma once

#include <optional>

#include "app/window/camera.hpp"
#include "app/window_options.hpp"

namespace quadrille::app {

/// What of the run is looked at, and how; changed by panels, keys and mouse.
struct ViewState {
    Camera camera;
    Overlays overlays;
    ColorBy colorBy = ColorBy::Entity;
    bool panels = true;
    bool help = false;
    bool vsync = true;
    bool fullScreen = false;

    bool timeline = false;  ///< there is one, below the world
    /// Where two runs are compared, which share the view: the size of their world, px.
    std::optional<Vec2> compared;

    bool fit = true;  ///< show all of the world, until the user moves the camera

    void pan(const Vec2& points) {
        camera.pan(points);
        fit = false;
    }

    void zoomAt(const Vec2& cursor, double factor, const ScreenRect& rect) {
        camera.zoomAt(cursor, factor, rect);
        fit = false;
    }

    // Asked for, and done by the main loop.
    bool screenshot = false;
    bool quit = false;
    int zoomSteps = 0;   ///< towards the centre of the view
    int scaleSteps = 0;  ///< of text and panels
};

}  // namespace quadrille::app
