#include "app/window/comparison_view.hpp"

#include <algorithm>
#include <array>
#include <imgui.h>
#include <string>
#include <vector>

#include "app/window/nice_numbers.hpp"
#include "app/window/text.hpp"
#include "app/window/theme.hpp"

namespace quadrille::app {

namespace {

/// Of the two lines of a plot.
constexpr std::array<ImU32, 2> lineColors = {IM_COL32(255, 176, 64, 255),
                                             IM_COL32(96, 190, 255, 255)};

ImVec2 low(const ScreenRect& rect) { return {float(rect.x), float(rect.y)}; }
ImVec2 high(const ScreenRect& rect) {
    return {float(rect.x + rect.width), float(rect.y + rect.height)};
}

/// Two quantities over the time of the comparison.
struct Plot {
    const char* title;
    std::array<std::string, 2> names;
    std::array<double, 2> ComparisonPoint::*values;
    bool counts = true;   ///< whole numbers
    bool spikes = false;  ///< a few values far above the others may leave the plot
};

double topOf(const Plot& plot, const std::vector<ComparisonPoint>& points) {
    std::vector<float> values;
    for (const ComparisonPoint& point : points) {
        for (const double value : point.*plot.values) values.push_back(float(value));
    }
    const double top = niceCeiling(percentile(values, plot.spikes ? 0.95 : 1));
    return top > 0 ? top : 1;
}

std::string valueText(const Plot& plot, double value) {
    if (plot.counts) return grouped(static_cast<std::uint64_t>(value));
    return value < 1e-9 ? "0" : formatted("%.3g", value);
}

void drawPlot(ImDrawList& list, const Plot& plot, const ScreenRect& rect, double scale,
              const std::vector<ComparisonPoint>& points) {
    const float line = ImGui::GetFontSize();
    const auto pad = float(5 * scale);
    list.AddRectFilled(low(rect), high(rect), packed(theme.panel));
    list.AddRect(low(rect), high(rect), packed(theme.border));
    const ImVec2 from(low(rect).x + pad, low(rect).y + 2 * line + 2 * pad);
    const ImVec2 to(high(rect).x - pad, high(rect).y - line - pad);
    list.AddText({from.x, low(rect).y + pad / 2}, packed(theme.faintText), plot.title);
    float x = from.x;
    for (std::size_t k = 0; k < 2; ++k) {
        const double now = points.empty() ? 0 : (points.back().*plot.values)[k];
        const std::string legend = plot.names[k] + " " + valueText(plot, now);
        list.AddText({x, low(rect).y + pad / 2 + line}, lineColors[k], legend.c_str());
        x += ImGui::CalcTextSize(legend.c_str()).x + 2 * pad;
    }
    const double top = topOf(plot, points);
    list.AddLine({from.x, from.y}, {to.x, from.y}, packed(theme.border));
    list.AddLine({from.x, to.y}, {to.x, to.y}, packed(theme.border));
    list.AddText({from.x, from.y}, packed(theme.faintText),
                 plot.counts ? grouped(std::uint64_t(top)).c_str() : formatted("%g", top).c_str());
    const double end = points.empty() ? 0 : points.back().time;
    const std::string endText = formatted("%.3g s", end);
    list.AddText({from.x, to.y + 1}, packed(theme.faintText), "0");
    list.AddText({to.x - ImGui::CalcTextSize(endText.c_str()).x, to.y + 1}, packed(theme.faintText),
                 endText.c_str());
    if (points.size() < 2 || to.y <= from.y || to.x <= from.x) return;
    // A line along the edge is whole.
    const auto thickness = float(1.5 * scale);
    list.PushClipRect({from.x, from.y - thickness}, {to.x, to.y + thickness}, true);
    // Of the points that would share some pixels, the highest is shown.
    const auto bins = std::max<std::size_t>(2, std::size_t(double(to.x - from.x) / (3 * scale)));
    const std::size_t each = (points.size() + bins - 1) / bins;
    std::vector<ImVec2> path;
    for (std::size_t k = 2; k-- > 0;) {
        path.clear();
        for (std::size_t i = 0; i < points.size(); i += each) {
            const std::size_t past = std::min(i + each, points.size());
            double most = 0;
            for (std::size_t j = i; j < past; ++j)
                most = std::max(most, (points[j].*plot.values)[k]);
            path.emplace_back(from.x + float(points[past - 1].time / end) * (to.x - from.x),
                              to.y - float(most / top) * (to.y - from.y));
        }
        list.AddPolyline(path.data(), int(path.size()), lineColors[k], 0, thickness);
    }
    list.PopClipRect();
}

void drawName(ImDrawList& list, const ScreenRect& rect, double scale, const std::string& name,
              const std::string& about, bool bad) {
    list.AddRectFilled(low(rect), high(rect), packed(theme.panel));
    const auto pad = float(8 * scale);
    const float y = low(rect).y + (float(rect.height) - ImGui::GetFontSize()) / 2;
    list.PushClipRect(low(rect), high(rect), true);
    list.AddText({low(rect).x + pad, y}, packed(theme.text), name.c_str());
    list.AddText({high(rect).x - pad - ImGui::CalcTextSize(about.c_str()).x, y},
                 bad ? packed(theme.errorText) : packed(theme.faintText), about.c_str());
    list.PopClipRect();
}

void drawSelection(ImDrawList& list, const PanelContext& context, const ScreenRect& view) {
    const World& world = context.bench.session().beside()->run().simulation.world();
    const auto entity = context.bench.selected();
    if (!entity || !world.isBody(*entity)) return;
    const Camera& camera = context.view.camera;
    const Vec2 center = camera.toScreen(world.get<Transform>(*entity).position, view);
    const Vec2 size = world.get<BoxCollider>(*entity).size * camera.zoom();
    const Vec2 half = (size / 2).cwiseMax(Vec2(5, 5)) + Vec2(2, 2);
    list.PushClipRect(low(view), high(view), true);
    list.AddRect({float(center.x() - half.x()), float(center.y() - half.y())},
                 {float(center.x() + half.x()), float(center.y() + half.y())},
                 packed(theme.selection), 0, 0, 2);
    list.PopClipRect();
}

}  // namespace

void showComparison(const PanelContext& context) {
    const RunBeside& beside = *context.bench.session().beside();
    const ComparisonLayout layout =
        comparisonLayout(context.view, context.scale, context.width, context.height);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const auto labels = context.bench.labels();
    const ComparedFrame* last = beside.last();
    const accuracy::Divergence d = last != nullptr ? last->divergence : accuracy::Divergence{};
    const std::string wrong = d.wrongBodies == 0
                                  ? std::string("no velocity differs")
                                  : grouped(d.wrongBodies) + " of " + grouped(d.bodies) + " wrong";
    drawName(list, layout.names[0], context.scale, labels[0], wrong, d.wrongBodies > 0);
    drawName(list, layout.names[1], context.scale, labels[1], formatted("%.3f s", d.time), false);
    drawSelection(list, context, layout.views[1]);

    const std::array<Plot, 4> plots = {{
        {"bodies", {"apart", "wrong"}, &ComparisonPoint::bodies},
        {"collisions", {"missed", "invented"}, &ComparisonPoint::collisions},
        {"deepest overlap, sides", labels, &ComparisonPoint::overlap, false},
        {"cost of a frame, ms", labels, &ComparisonPoint::cost, false, true},
    }};
    const std::vector<ComparisonPoint>& points = context.bench.comparison().points();
    const ScreenRect& strip = layout.strip;
    const double width = strip.width / double(plots.size());
    for (std::size_t k = 0; k < plots.size(); ++k) {
        drawPlot(list, plots[k], {strip.x + double(k) * width, strip.y, width, strip.height},
                 context.scale, points);
    }
}

void showComparisonPanel(const PanelContext& context) {
    if (!sectionHeader("Comparison", "The first run, held against the second.")) return;
    const ComparedFrame* last = context.bench.session().beside()->last();
    const auto labels = context.bench.labels();
    ImGui::TextWrapped("%s, held against %s", labels[0].c_str(), labels[1].c_str());
    if (last == nullptr || !ImGui::BeginTable("comparison", 2)) return;
    const auto row = [](const char* name, const std::string& value) {
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", name);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(value.c_str());
    };
    const accuracy::Divergence& d = last->divergence;
    row("bodies apart", grouped(d.apart));
    row("wrong bodies", grouped(d.wrongBodies));
    row("collisions", grouped(d.events.matched) + " the same");
    row("missed", grouped(d.events.missed()));
    row("invented", grouped(d.events.invented()));
    row("state", last->stateHash[0] == last->stateHash[1] ? "the same bits" : "differs");
    ImGui::EndTable();
}

}  // namespace quadrille::app
