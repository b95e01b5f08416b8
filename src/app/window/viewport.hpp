#pragma once

#include "app/window/camera.hpp"

namespace quadrille::app {

/// The part of the window that shows the world, as the GPU sees it.
struct Viewport {
    Camera camera;
    ScreenRect view;        ///< points
    double pixelRatio = 1;  ///< framebuffer pixels per point

    /// Framebuffer pixels per px of the world.
    double pixelsPerUnit() const { return camera.zoom() * pixelRatio; }
    /// Clip-space units per px of the world.
    Vec2 clipScale() const {
        return {2 * camera.zoom() / view.width, 2 * camera.zoom() / view.height};
    }
};

}  // namespace quadrille::app
