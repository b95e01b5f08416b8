#pragma once

#include <array>

#include "app/window/camera.hpp"

namespace quadrille::app {

/// How a comparison divides what the panels leave of the window: a view for each run, of the same
/// size, each below a line that names it, and a strip of plots below both.
struct ComparisonLayout {
    std::array<ScreenRect, 2> names, views;
    ScreenRect strip;
};

/// The views stand side by side or one above the other, as shows a world of that size larger.
/// `scale` is that of text.
ComparisonLayout layOutComparison(const ScreenRect& area, const Vec2& world, double scale);

}  // namespace quadrille::app
