#include "app/window/panels.hpp"

#include <algorithm>
#include <imgui.h>

namespace quadrille::app {

namespace {

constexpr double columnPoints = 300;

}  // namespace

ScreenRect worldRect(const ViewState& view, double scale, int width, int height) {
    const double column = view.panels ? columnPoints * scale : 0;
    // However narrow the window is, there is a view to calculate with.
    return {column, 0, std::max(1.0, width - column), std::max(1.0, double(height))};
}

bool sectionHeader(const char* label) {
    return ImGui::CollapsingHeader(label, ImGuiTreeNodeFlags_DefaultOpen);
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
        showCollisionsPanel(context);
        showDisplayPanel(context);
        showCountersPanel(context);
        showFrameTimePanel(context);
        showLoadPanel(context);
        ImGui::PopItemWidth();
        ImGui::End();
    }
    showEntityWindow(context);
    showHelpWindow(context);
    showMessage(context);
}

}  // namespace quadrille::app
