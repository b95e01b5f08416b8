#include "app/window/velocity_arrows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "app/window/nice_numbers.hpp"
#include "app/window/text.hpp"
#include "app/window/theme.hpp"

namespace quadrille::app {

namespace {

constexpr double longest = 44;  // points, of the arrow at the end of the scale
constexpr double shortest = 2;  // a shorter one shows no direction, and is left out
constexpr double room = 26;     // points: of the arrows that start in such a square, one is shown

struct Arrow {
    Vec2 at;        // on the screen
    Vec2 velocity;  // px/s, y up
    std::uint32_t created;
};

template <class Real>
std::vector<Arrow> arrowsInView(const BodyView<Real>& bodies, const Camera& camera,
                                const ScreenRect& view) {
    const Vec2 corner = camera.toWorld({view.x, view.y}, view);
    const Vec2 opposite = camera.toWorld({view.x + view.width, view.y + view.height}, view);
    const Vec2 low = corner.cwiseMin(opposite), high = corner.cwiseMax(opposite);
    std::vector<Arrow> arrows;
    const auto& m = bodies.moving;
    for (std::size_t i = 0; i < m.size(); ++i) {
        const Vec2 place(double(m.x[i]), double(m.y[i]));
        if ((place.array() < low.array()).any() || (place.array() > high.array()).any()) continue;
        arrows.push_back(
            {camera.toScreen(place, view), Vec2(double(m.vx[i]), double(m.vy[i])), m.created[i]});
    }
    return arrows;
}

/// Leaves one of those in each square of a grid over the view: the body that was created first.
void thin(std::vector<Arrow>& arrows, const ScreenRect& view, double square) {
    const auto columns = static_cast<std::size_t>(view.width / square) + 1;
    const auto rows = static_cast<std::size_t>(view.height / square) + 1;
    std::vector<const Arrow*> first(columns * rows, nullptr);
    for (const Arrow& arrow : arrows) {
        const Vec2 place = (arrow.at - Vec2(view.x, view.y)).cwiseMax(Vec2(0, 0)) / square;
        const auto column = std::min(static_cast<std::size_t>(place.x()), columns - 1);
        const auto row = std::min(static_cast<std::size_t>(place.y()), rows - 1);
        const Arrow*& kept = first[row * columns + column];
        if (kept == nullptr || arrow.created < kept->created) kept = &arrow;
    }
    std::vector<Arrow> left;
    for (const Arrow* arrow : first) {
        if (arrow != nullptr) left.push_back(*arrow);
    }
    arrows = std::move(left);
}

void drawArrow(ImDrawList& list, const Vec2& from, const Vec2& along, float thickness) {
    const double length = along.norm();
    const Vec2 direction = along / length, across(-direction.y(), direction.x());
    const double head = std::min(2.2 * double(thickness) + 2, length);
    const Vec2 tip = from + along, neck = tip - head * direction;
    const auto point = [](const Vec2& p) { return ImVec2(float(p.x()), float(p.y())); };
    const auto draw = [&](ImU32 color, float extra) {
        list.AddLine(point(from), point(neck), color, thickness + 2 * extra);
        const double half = 0.5 * head + double(extra);
        list.AddTriangleFilled(point(tip + 1.5 * double(extra) * direction),
                               point(neck + half * across - double(extra) * direction),
                               point(neck - half * across - double(extra) * direction), color);
    };
    draw(IM_COL32(8, 10, 14, 150), 1);  // so that it shows over anything
    draw(packed(theme.arrow), 0);
}

}  // namespace

std::optional<LengthKey> drawVelocityArrows(ImDrawList& list, const World& world,
                                            const Camera& camera, const ScreenRect& view,
                                            double scale) {
    std::vector<Arrow> arrows;
    world.visitBodies([&](const auto& bodies) { arrows = arrowsInView(bodies, camera, view); });
    double fastest = 0;
    for (const Arrow& arrow : arrows) fastest = std::max(fastest, arrow.velocity.norm());
    const double top = niceCeiling(fastest);
    if (top == 0) return std::nullopt;
    const std::size_t bodies = arrows.size();
    thin(arrows, view, room * scale);
    for (const Arrow& arrow : arrows) {
        const Vec2 along = Vec2(arrow.velocity.x(), -arrow.velocity.y()) * (longest * scale / top);
        if (along.norm() < shortest * scale) continue;
        drawArrow(list, arrow.at, along, float(1.5 * scale));
    }
    const std::string title = arrows.size() == bodies ? "velocity"
                                                      : "velocity, of " + grouped(arrows.size()) +
                                                            " of " + grouped(bodies) + " bodies";
    return LengthKey{title, packed(theme.arrow), longest * scale, compact(top) + " px/s"};
}

}  // namespace quadrille::app
