#include "app/window/comparison_layout.hpp"

#include <algorithm>

namespace quadrille::app {

namespace {

constexpr double namePoints = 24, gapPoints = 2;
constexpr double leastStrip = 90, mostStrip = 170;  // points
constexpr double shareOfStrip = 0.24;

double zoomOf(const ScreenRect& view, const Vec2& world) {
    return std::min(view.width / world.x(), view.height / world.y());
}

}  // namespace

ComparisonLayout layOutComparison(const ScreenRect& area, const Vec2& world, double scale) {
    const double name = namePoints * scale, gap = gapPoints * scale;
    const double strip =
        std::clamp(shareOfStrip * area.height, leastStrip * scale, mostStrip * scale);
    const double height = std::max(1.0, area.height - strip);
    const auto divided = [&](bool beside) {
        const double width = beside ? std::max(1.0, (area.width - gap) / 2) : area.width;
        const double each = beside ? height : std::max(1.0, (height - gap) / 2);
        ComparisonLayout layout;
        for (std::size_t run = 0; run < 2; ++run) {
            const double x = area.x + (beside ? double(run) * (width + gap) : 0);
            const double y = area.y + (beside ? 0 : double(run) * (each + gap));
            layout.names[run] = {x, y, width, name};
            layout.views[run] = {x, y + name, width, std::max(1.0, each - name)};
        }
        layout.strip = {area.x, area.y + height, area.width, strip};
        return layout;
    };
    const ComparisonLayout beside = divided(true), above = divided(false);
    return zoomOf(beside.views[0], world) >= zoomOf(above.views[0], world) ? beside : above;
}

}  // namespace quadrille::app
