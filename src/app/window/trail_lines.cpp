#include "app/window/trail_lines.hpp"

#include <algorithm>
#include <imgui.h>
#include <vector>

namespace quadrille::app {

namespace {

constexpr double seconds = 2;
/// Of more bodies, every n-th has a trail.
constexpr std::size_t mostTrails = 250;
/// So many pieces, each fainter than the one after it.
constexpr std::size_t shades = 4;
/// A body that turns by less goes straight on, as a sine.
constexpr float leastTurn = 0.02f;

bool turns(const ImVec2& from, const ImVec2& at, const ImVec2& to) {
    const ImVec2 a(at.x - from.x, at.y - from.y), b(to.x - at.x, to.y - at.y);
    const float cross = a.x * b.y - a.y * b.x, dot = a.x * b.x + a.y * b.y;
    return dot < 0 || cross * cross > leastTurn * leastTurn * (dot * dot + cross * cross);
}

void drawTrail(ImDrawList& list, const std::vector<Trails::Place>& trail, const Camera& camera,
               const ScreenRect& rect, double scale) {
    const auto pointAt = [&](std::size_t i) {
        const Vec2 point = camera.toScreen(Vec2(trail[i].x, trail[i].y), rect);
        return ImVec2(float(point.x()), float(point.y()));
    };
    const std::size_t piece = (trail.size() + shades - 1) / shades;
    std::vector<ImVec2> path;
    for (std::size_t i = 0; i < trail.size(); ++i) {
        const ImVec2 here = pointAt(i);
        const bool last = i + 1 == trail.size(), ends = i > 0 && (last || i % piece == 0);
        // Most bodies go straight for most of the time.
        if (path.empty() || ends || turns(path.back(), here, pointAt(i + 1))) path.push_back(here);
        if (!ends) continue;
        const int alpha = int(40 + 160 * ((i + piece - 1) / piece) / shades);
        list.AddPolyline(path.data(), int(path.size()), IM_COL32(255, 225, 150, alpha), 0,
                         float(1.2 * scale));
        path = {here};
    }
}

}  // namespace

void showTrails(const PanelContext& context) {
    const Workbench& bench = context.bench;
    if (!context.view.overlays.trails || context.view.compared) return;
    const ScreenRect rect = worldRect(context.view, context.scale, context.width, context.height);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect({float(rect.x), float(rect.y)},
                      {float(rect.x + rect.width), float(rect.y + rect.height)});
    const World& world = bench.simulation().world();
    const std::uint64_t step = bench.simulation().stepsDone();
    const auto steps = std::uint64_t(std::max(1.0, seconds / bench.config().step.dt));
    const auto selected = bench.selected();
    world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        const CreationRanks ranks(m.created, m.size());
        const auto draw = [&](std::size_t row) {
            drawTrail(list, bench.trails().of(ranks[row], step, steps), context.view.camera, rect,
                      context.scale);
        };
        if (selected) {
            const auto row = std::find(m.entity.begin(), m.entity.end(), selected->index);
            if (row != m.entity.end()) draw(std::size_t(row - m.entity.begin()));
            return;
        }
        const std::size_t apart = (m.size() + mostTrails - 1) / mostTrails;
        for (std::size_t row = 0; row < m.size(); row += std::max<std::size_t>(apart, 1)) draw(row);
    });
    list.PopClipRect();
}

}  // namespace quadrille::app
