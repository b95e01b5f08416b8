#pragma once

#include <quadrille/cells.hpp>
#include <quadrille/vec2.hpp>

namespace quadrille::app {

/// A rectangle on the screen, in points (SDL's window coordinates) from the window's top left.
struct ScreenRect {
    double x = 0, y = 0, width = 1, height = 1;

    Vec2 center() const { return {x + width / 2, y + height / 2}; }
    bool contains(const Vec2& p) const {
        return p.x() >= x && p.x() < x + width && p.y() >= y && p.y() < y + height;
    }
};

/// Which part of the world a view shows: the point at its centre, and how large a px of the world
/// is on the screen. y points up in the world and down on the screen.
class Camera {
  public:
    Vec2 center{0, 0};  ///< world, px

    /// Points per px of the world.
    double zoom() const { return zoom_; }

    Vec2 toScreen(const Vec2& world, const ScreenRect& view) const;
    Vec2 toWorld(const Vec2& screen, const ScreenRect& view) const;

    /// Moves the picture by so many points.
    void pan(const Vec2& points);
    /// Zooms so that the world stays where it is under `cursor`.
    void zoomAt(const Vec2& cursor, double factor, const ScreenRect& view);
    /// Shows all of a part of the world, with a narrow margin.
    void fit(const Bounds& part, const ScreenRect& view);

  private:
    double zoom_ = 1;
};

}  // namespace quadrille::app
