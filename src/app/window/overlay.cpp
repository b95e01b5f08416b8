#include <algorithm>
#include <array>
#include <cstdio>
#include <imgui.h>
#include <optional>
#include <string>

#include "app/window/colors.hpp"
#include "app/window/panels.hpp"

namespace quadrille::app {

namespace {

constexpr ImU32 selectionColor = IM_COL32(255, 235, 130, 255);
constexpr ImU32 collidedColor = IM_COL32(255, 120, 80, 255);
constexpr ImU32 touchingColor = IM_COL32(200, 200, 200, 200);

ImVec2 toImGui(const Vec2& p) { return {float(p.x()), float(p.y())}; }

struct Box {
    Vec2 low, high;
};

std::optional<Box> boxOf(const World& world, Entity entity) {
    if (!world.isBody(entity)) return std::nullopt;
    const Vec2 position = world.get<Transform>(entity).position;
    const Vec2 half = world.get<BoxCollider>(entity).size / 2;
    return Box{position - half, position + half};
}

void drawSelection(ImDrawList& list, const PanelContext& context, const ScreenRect& rect) {
    const World& world = context.bench.simulation().world();
    const auto entity = context.bench.selected();
    const auto box = entity ? boxOf(world, *entity) : std::nullopt;
    if (!box) return;
    const Camera& camera = context.view.camera;
    const Vec2 center = camera.toScreen((box->low + box->high) / 2, rect);
    // Never so small that it cannot be seen.
    const Vec2 half =
        ((box->high - box->low) * camera.zoom() / 2).cwiseMax(Vec2(5, 5)) + Vec2(2, 2);
    list.AddRect(toImGui(center - half), toImGui(center + half), selectionColor, 0, 0, 2);
    const PhysicsBody body = world.get<PhysicsBody>(*entity);
    if (body.isStatic) return;
    // Where it will be in half a second.
    const Vec2 velocity = body.velocity * camera.zoom() / 2;
    list.AddLine(toImGui(center), toImGui(center + Vec2(velocity.x(), -velocity.y())),
                 selectionColor, 2);
}

void drawContacts(ImDrawList& list, const PanelContext& context, const ScreenRect& rect) {
    const World& world = context.bench.simulation().world();
    const auto selected = context.bench.selected();
    for (const Contact& contact : context.bench.contacts()) {
        const bool ofSelected = selected && (contact.a == *selected || contact.b == *selected);
        if (!context.view.overlays.contacts && !ofSelected) continue;
        const auto a = boxOf(world, contact.a);
        const auto b = boxOf(world, contact.b);
        if (!a || !b) continue;
        // The middle of what the boxes share, or of the gap that they have left since.
        const Vec2 place = (a->low.cwiseMax(b->low) + a->high.cwiseMin(b->high)) / 2;
        const Vec2 at = context.view.camera.toScreen(place, rect);
        if (!rect.contains(at)) continue;
        const Vec2 half(2.5, 2.5);
        list.AddRectFilled(toImGui(at - half), toImGui(at + half),
                           contact.collided ? collidedColor : touchingColor);
    }
}

void drawHeatLegend(ImDrawList& list, const PanelContext& context, const ScreenRect& rect) {
    const double scale = context.scale;
    const std::size_t most = context.measures.load.maxBodies;
    const float width = float(200 * scale), height = float(10 * scale);
    const ImVec2 low(float(rect.x + rect.width - 16 * scale) - width,
                     float(rect.y + rect.height - 38 * scale));
    const float pad = float(8 * scale);
    const float line = ImGui::GetFontSize();
    list.AddRectFilled({low.x - pad, low.y - line - pad},
                       {low.x + width + pad, low.y + height + line + pad},
                       IM_COL32(20, 24, 29, 225), 3);
    list.AddText({low.x, low.y - line - 2}, IM_COL32_WHITE, "bodies per cell");
    constexpr int pieces = 50;
    for (int i = 0; i < pieces; ++i) {
        const Color c = heatColor((i + 0.5) / pieces);
        list.AddRectFilled({low.x + width * float(i) / pieces, low.y},
                           {low.x + width * float(i + 1) / pieces, low.y + height},
                           IM_COL32(c.r, c.g, c.b, 255));
    }
    // The scale is a square root: a quarter of the most stands in the middle.
    const std::array<std::size_t, 3> ticks = {0, most / 4, most};
    for (std::size_t k = 0; k < ticks.size(); ++k) {
        const std::string number = std::to_string(ticks[k]);
        const float share = float(heatScale(ticks[k], most));
        const float textWidth = ImGui::CalcTextSize(number.c_str()).x;
        const float x =
            std::clamp(low.x + share * width - textWidth / 2, low.x, low.x + width - textWidth);
        list.AddText({x, low.y + height + 2}, IM_COL32_WHITE, number.c_str());
        if (most < 8 && k == 0) break;  // the numbers would stand on each other
    }
}

}  // namespace

void showOverlay(const PanelContext& context) {
    const ScreenRect rect = worldRect(context.view, context.scale, context.width, context.height);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect({float(rect.x), float(rect.y)},
                      {float(rect.x + rect.width), float(rect.y + rect.height)});
    drawContacts(list, context, rect);
    drawSelection(list, context, rect);
    if (context.view.overlays.heatMap) drawHeatLegend(list, context, rect);
    list.PopClipRect();
}

}  // namespace quadrille::app
