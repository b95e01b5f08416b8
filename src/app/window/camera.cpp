#include "app/window/camera.hpp"

#include <algorithm>

namespace quadrille::app {

namespace {

constexpr double leastZoom = 1e-7, mostZoom = 1e5;

}  // namespace

Vec2 Camera::toScreen(const Vec2& world, const ScreenRect& view) const {
    const Vec2 offset = (world - center) * zoom_;
    return view.center() + Vec2(offset.x(), -offset.y());
}

Vec2 Camera::toWorld(const Vec2& screen, const ScreenRect& view) const {
    const Vec2 offset = (screen - view.center()) / zoom_;
    return center + Vec2(offset.x(), -offset.y());
}

void Camera::pan(const Vec2& points) { center += Vec2(-points.x(), points.y()) / zoom_; }

void Camera::zoomAt(const Vec2& cursor, double factor, const ScreenRect& view) {
    const Vec2 fixed = toWorld(cursor, view);
    zoom_ = std::clamp(zoom_ * factor, leastZoom, mostZoom);
    center += fixed - toWorld(cursor, view);
}

void Camera::fit(const Bounds& part, const ScreenRect& view) {
    constexpr double margin = 1.02;
    const Vec2 size = (part.high - part.low) * margin;
    center = (part.low + part.high) / 2;
    zoom_ =
        std::clamp(std::min(view.width / size.x(), view.height / size.y()), leastZoom, mostZoom);
}

}  // namespace quadrille::app
