#include "app/window/overlay.hpp"

#include <array>
#include <imgui.h>
#include <optional>
#include <string>
#include <vector>

#include "app/window/colors.hpp"
#include "app/window/contact_marks.hpp"
#include "app/window/legends.hpp"
#include "app/window/text.hpp"
#include "app/window/theme.hpp"
#include "app/window/velocity_arrows.hpp"

namespace quadrille::app {

namespace {

ImVec2 toImGui(const Vec2& p) { return {float(p.x()), float(p.y())}; }

void drawSelection(ImDrawList& list, const PanelContext& context, const ScreenRect& rect) {
    const World& world = context.bench.simulation().world();
    const auto entity = context.bench.selected();
    if (!entity || !world.isBody(*entity)) return;
    const Camera& camera = context.view.camera;
    const Vec2 center = camera.toScreen(world.get<Transform>(*entity).position, rect);
    const Vec2 size = world.get<BoxCollider>(*entity).size * camera.zoom();
    // Never so small that it cannot be seen.
    const Vec2 half = (size / 2).cwiseMax(Vec2(5, 5)) + Vec2(2, 2);
    const ImU32 color = packed(theme.selection);
    list.AddRect(toImGui(center - half), toImGui(center + half), color, 0, 0, 2);
    const PhysicsBody body = world.get<PhysicsBody>(*entity);
    if (body.isStatic) return;
    // Where it will be in half a second.
    const Vec2 velocity = body.velocity * camera.zoom() / 2;
    list.AddLine(toImGui(center), toImGui(center + Vec2(velocity.x(), -velocity.y())), color, 2);
}

void addColorLegend(const ColorScale& scale, Legends& legends) {
    if (scale.by == ColorBy::Entity || scale.by == ColorBy::Cell) return;
    const std::string end = compact(scale.top) + (scale.beyond ? " and more" : "");
    const std::array<Legends::Tick, 3> ticks = {
        {{0, "0"}, {0.5, compact(scale.top / 2)}, {1, end}}};
    switch (scale.by) {
        case ColorBy::Speed:
            return legends.addColors("speed, px/s", speedColor, ticks);
        case ColorBy::Energy:
            return legends.addColors("kinetic energy, kg px\u00b2/s\u00b2", energyColor, ticks);
        default: {
            if (scale.top > 0) {
                return legends.addColors("time since the last hit, s", sinceHitColor, ticks);
            }
            const std::array<Legends::Tick, 2> ends = {{{0, "hit now"}, {1, "never"}}};
            return legends.addColors("time since the last hit", sinceHitColor, ends);
        }
    }
}

void addHeatLegend(std::size_t most, Legends& legends) {
    // The scale is a square root: a quarter of the most stands in the middle.
    std::vector<Legends::Tick> ticks;
    for (const std::size_t count : {std::size_t(0), most / 4, most}) {
        if (count == 0 && !ticks.empty()) continue;
        ticks.push_back({heatScale(count, most), grouped(count)});
    }
    legends.addColors("bodies per cell", heatColor, ticks);
}

}  // namespace

void showOverlay(const PanelContext& context, const ColorScale& colors) {
    const ScreenRect rect = worldRect(context.view, context.scale, context.width, context.height);
    const Overlays& overlays = context.view.overlays;
    const Workbench& bench = context.bench;
    const World& world = bench.simulation().world();
    const Camera& camera = context.view.camera;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect({float(rect.x), float(rect.y)},
                      {float(rect.x + rect.width), float(rect.y + rect.height)});
    std::optional<LengthKey> velocities, impulses;
    if (overlays.arrows) velocities = drawVelocityArrows(list, world, camera, rect, context.scale);
    if (overlays.contacts || bench.selected()) {
        const auto only = overlays.contacts ? std::nullopt : bench.selected();
        impulses =
            drawContactMarks(list, world, bench.contacts(), only, camera, rect, context.scale);
    }
    drawSelection(list, context, rect);
    Legends legends(list, rect, context.scale);  // above all of that
    if (velocities) legends.addLength(*velocities);
    if (impulses) legends.addLength(*impulses);
    addColorLegend(colors, legends);
    if (overlays.heatMap) addHeatLegend(context.measures.load.maxBodies, legends);
    list.PopClipRect();
}

}  // namespace quadrille::app
