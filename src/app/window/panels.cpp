#include "app/window/panels.hpp"

#include <algorithm>
#include <imgui.h>
#include <imgui_internal.h>  // how long the mouse has rested

#include "app/window/comparison_view.hpp"
#include "app/window/timeline_bar.hpp"

namespace quadrille::app {

namespace {

constexpr double columnPoints = 320, timelinePoints = 34;

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

bool sectionHeader(const char* label, const char* meaning) {
    const bool open = ImGui::CollapsingHeader(label, ImGuiTreeNodeFlags_DefaultOpen);
    tooltip(meaning);
    return open;
}

void tooltip(const char* text) {
    constexpr float restSeconds = 0.4f;
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    // A text knows not how long the mouse has been over it.
    const ImGuiContext& gui = *ImGui::GetCurrentContext();
    if (gui.HoveredId != 0 && gui.HoveredIdTimer < restSeconds) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(24 * ImGui::GetFontSize());
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void showPanels(const PanelContext& context) {
    if (context.view.panels) {
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({float(columnPoints * context.scale), float(context.height)});
        ImGui::Begin("panels", nullptr,
                     ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus);
        ImGui::PushItemWidth(float(-104 * context.scale));
        showRunPanel(context);
        showScenePanel(context);
        if (context.view.compared) {
            showComparisonPanel(context);
        } else {
            showCollisionsPanel(context);
        }
        showDisplayPanel(context);
        showErrorPanel(context);
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
