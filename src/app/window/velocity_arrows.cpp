#include "app/window/velocity_arrows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "app/window/nice_numbers.hpp"
#include "app/window/text.hpp"
#include "app/window/theme.hpp"

namespace quadrille::app {

namespace {

constexpr double longest = 44;  // points, of the arrow at the end of the scale
constexpr double shortest = 2;  // a shorter one shows no direction, and is left out
constexpr double room = 32;     // points: of the arrows that start in such a square, one is shown

struct Arrow {
    Vec2 at;        // on the screen
    Vec2 velocity;  // px/s, y up
};

struct Crowd {
    std::vector<Arrow> arrows;
    std::size_t bodies = 0;  // in view
    double fastest = 0;      // of them, px/s
};

/// Of the bodies in each square of a grid over the view, the one that was created first.
template <class Real>
Crowd crowdInView(const BodyView<Real>& bodies, const Camera& camera, const ScreenRect& view,
                  double square) {
    const Vec2 corner = camera.toWorld({view.x, view.y}, view);  // the upper left
    const double zoom = camera.zoom();
    const auto columns = static_cast<std::size_t>(view.width / square) + 1;
    const auto rows = static_cast<std::size_t>(view.height / square) + 1;
    constexpr std::size_t nobody = ~std::size_t(0);
    std::vector<std::size_t> first(columns * rows, nobody);
    Crowd crowd;
    double squaredSpeed = 0;
    const auto& m = bodies.moving;
    for (std::size_t i = 0; i < m.size(); ++i) {
        const double x = (double(m.x[i]) - corner.x()) * zoom;
        const double y = (corner.y() - double(m.y[i])) * zoom;
        if (!(x >= 0 && y >= 0 && x < view.width && y < view.height)) continue;
        ++crowd.bodies;
        const double vx(m.vx[i]), vy(m.vy[i]);
        squaredSpeed = std::max(squaredSpeed, vx * vx + vy * vy);
        std::size_t& kept = first[static_cast<std::size_t>(y / square) * columns +
                                  static_cast<std::size_t>(x / square)];
        if (kept == nobody || m.created[i] < m.created[kept]) kept = i;
    }
    crowd.fastest = std::sqrt(squaredSpeed);
    for (const std::size_t i : first) {
        if (i == nobody) continue;
        const Vec2 place(double(m.x[i]), double(m.y[i]));
        crowd.arrows.push_back(
            {camera.toScreen(place, view), Vec2(double(m.vx[i]), double(m.vy[i]))});
    }
    return crowd;
}

void drawArrow(ImDrawList& list, const Vec2& from, const Vec2& along, float thickness) {
    const double length = along.norm();
    const Vec2 direction = along / length, across(-direction.y(), direction.x());
    const double head = std::min(2.2 * double(thickness) + 2, length);
    const Vec2 tip = from + along, neck = tip - head * direction;
    const auto point = [](const Vec2& p) { return ImVec2(float(p.x()), float(p.y())); };
    // A dark rim, so that it shows over anything.
    list.AddLine(point(from), point(tip), IM_COL32(8, 10, 14, 150), thickness + 2);
    const double half = head / 2;
    list.AddLine(point(from), point(neck), packed(theme.arrow), thickness);
    list.AddTriangleFilled(point(tip), point(neck + half * across), point(neck - half * across),
                           packed(theme.arrow));
}

}  // namespace

std::optional<LengthKey> drawVelocityArrows(ImDrawList& list, const World& world,
                                            const Camera& camera, const ScreenRect& view,
                                            double scale) {
    Crowd crowd;
    world.visitBodies(
        [&](const auto& bodies) { crowd = crowdInView(bodies, camera, view, room * scale); });
    const double top = niceCeiling(crowd.fastest);
    if (top == 0) return std::nullopt;
    // Dear ImGui draws lines of whole points faster.
    const auto thickness = static_cast<float>(std::round(1.5 * scale));
    for (const Arrow& arrow : crowd.arrows) {
        const Vec2 along = Vec2(arrow.velocity.x(), -arrow.velocity.y()) * (longest * scale / top);
        if (along.norm() < shortest * scale) continue;
        drawArrow(list, arrow.at, along, thickness);
    }
    const std::size_t shown = crowd.arrows.size();
    const std::string title = shown == crowd.bodies ? "velocity"
                                                    : "velocity, of " + grouped(shown) + " of " +
                                                          grouped(crowd.bodies) + " bodies";
    return LengthKey{title, packed(theme.arrow), longest * scale, compact(top) + " px/s"};
}

}  // namespace quadrille::app
