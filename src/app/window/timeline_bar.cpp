#include "app/window/timeline_bar.hpp"

#include <imgui.h>
#include <string>

#include "app/window/text.hpp"

namespace quadrille::app {

namespace {

/// "step 120, 2.000 s", and in the past whether the state has the bits that it had.
std::string placeText(const Workbench& bench) {
    std::string text = "step " + grouped(bench.simulation().stepsDone()) +
                       formatted(", %.3f s", bench.place() * bench.config().step.dt);
    if (!bench.lookingBack()) return text;
    if (bench.seeking()) return text + ", on the way";
    const auto same = bench.sameAsOnTheWay();
    if (same) text += *same ? ", the same bits" : ", other bits";
    return text;
}

}  // namespace

void showTimelineBar(const PanelContext& context) {
    Workbench& bench = context.bench;
    const ScreenRect rect =
        timelineRect(context.view, context.scale, context.width, context.height);
    ImGui::SetNextWindowPos({float(rect.x), float(rect.y)});
    ImGui::SetNextWindowSize({float(rect.width), float(rect.height)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                        {float(8 * context.scale), float(5 * context.scale)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::Begin("timeline", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNavInputs);
    ImGui::PopStyleVar(2);
    if (ImGui::ArrowButton("back", ImGuiDir_Left)) bench.stepBack();
    ImGui::SameLine();
    if (ImGui::ArrowButton("on", ImGuiDir_Right)) bench.singleStep();
    ImGui::SameLine();
    if (ImGui::Button(bench.backwards() ? "Forwards" : "Backwards")) bench.playBackwards();
    ImGui::SameLine();
    const std::string text =
        placeText(bench) +
        formatted(", hash %016llx", static_cast<unsigned long long>(bench.shownHash()));
    double place = bench.place();
    const auto first = double(bench.firstPlace()), last = double(bench.lastPlace());
    const bool newest = bench.lookingBack();
    ImGui::SetNextItemWidth(newest ? ImGui::GetContentRegionAvail().x - float(64 * context.scale)
                                   : -1);
    if (ImGui::SliderScalar("##place", ImGuiDataType_Double, &place, &first, &last, text.c_str(),
                            ImGuiSliderFlags_NoInput)) {
        bench.lookAt(place);
    }
    if (newest) {
        ImGui::SameLine();
        if (ImGui::Button("Newest", {-1, 0})) bench.toNewest();
    }
    ImGui::End();
}

}  // namespace quadrille::app
