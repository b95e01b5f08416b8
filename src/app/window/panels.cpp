#include "app/window/panels.hpp"

#include <algorithm>
#include <imgui.h>

#include "app/window/comparison_view.hpp"
#include "app/window/timeline_bar.hpp"
#include "app/window/trail_lines.hpp"

namespace quadrille::app {

namespace {

constexpr double columnPoints = 300, timelinePoints = 30;

ScreenRect besidePanels(const ViewState& view, double scale, int width, int height) {
    const double column = view.panels ? columnPoints * scale : 0;
    const double below = view.panels && view.timeline ? timelinePoints * scale : 0;
    // However narrow the window is, there is a view to calculate with.
    return {column, 0, std::max(1.0, width - column), std::max(1.0, height - below)};
}

}  // namespace

ScreenRect timelineRect(const ViewState& view, double scale, int width, int height) {
    const ScreenRect above = besidePanels(view, scale, width, height);
    return {above.x, above.height, above.width, std::max(1.0, height - above.height)};
}

ScreenRect worldRect(const ViewState& view, double scale, int width, int height) {
    if (view.compared) return comparisonLayout(view, scale, width, height).views[0];
    return besidePanels(view, scale, width, height);
}

ComparisonLayout comparisonLayout(const ViewState& view, double scale, int width, int height) {
    return layOutComparison(besidePanels(view, scale, width, height), *view.compared, scale);
}

bool sectionHeader(const char* label) {
    return ImGui::CollapsingHeader(label, ImGuiTreeNodeFlags_DefaultOpen);
}

void showPanels(const PanelContext& context) {
    showTrails(context);
    showOverlay(context);
    if (context.view.compared) showComparison(context);
    if (context.view.panels) {
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({float(columnPoints * context.scale), float(context.height)});
        ImGui::Begin("panels", nullptr,
                     ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus);
        ImGui::PushItemWidth(float(-104 * context.scale));
        showRunPanel(context);
        if (context.view.compared) {
            showComparisonPanel(context);
        } else {
            showCollisionsPanel(context);
        }
        showDisplayPanel(context);
        showCountersPanel(context);
        showFrameTimePanel(context);
        showLoadPanel(context);
        ImGui::PopItemWidth();
        ImGui::End();
    }
    if (context.view.panels && context.view.timeline) showTimelineBar(context);
    showEntityWindow(context);
    showHelpWindow(context);
    showMessage(context);
}

}  // namespace quadrille::app
