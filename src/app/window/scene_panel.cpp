#include <algorithm>
#include <array>
#include <cstdint>
#include <imgui.h>
#include <optional>
#include <string>
#include <utility>

#include "app/window/panels.hpp"

namespace quadrille::app {

namespace {

/// The scenes that come with the program, each with a line about it.
void chooseScene(Workbench& bench, double scale) {
    const std::string now = bench.session().run().scene;
    ImGui::SetNextItemWidth(-1);
    if (!ImGui::BeginCombo("##scene", now.c_str(), ImGuiComboFlags_HeightLargest)) {
        tooltip("What is run; a scene file can be dropped on the window, too. [ and ]");
        return;
    }
    std::optional<std::string> chosen;
    if (ImGui::BeginTable("scenes", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const ShippedScene& scene : bench.scenes()) {
            ImGui::TableNextRow(ImGuiTableRowFlags_None, float(20 * scale));
            ImGui::TableNextColumn();
            if (ImGui::Selectable(scene.name.c_str(), scene.name == now,
                                  ImGuiSelectableFlags_SpanAllColumns)) {
                chosen = scene.name;
            }
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", scene.about.c_str());
        }
        ImGui::EndTable();
    }
    ImGui::EndCombo();
    if (chosen) bench.open(*chosen);
}

/// A whole number that is taken over with Enter.
std::optional<std::uint64_t> edit(const char* label, std::uint64_t value, const char* meaning) {
    const bool entered = ImGui::InputScalar(label, ImGuiDataType_U64, &value, nullptr, nullptr,
                                            nullptr, ImGuiInputTextFlags_EnterReturnsTrue);
    tooltip(meaning);
    return entered ? std::optional(value) : std::nullopt;
}

void editStart(Workbench& bench) {
    const Run& run = bench.session().run();
    if (const auto seed = edit("seed", run.seed, "Of the random numbers; Enter starts anew.")) {
        bench.restartWith(*seed, std::nullopt);
        return;
    }
    if (!run.spawned) return;
    if (const auto count = edit("count", *run.spawned,
                                "Bodies of the scene's first spawn group; Enter starts anew.")) {
        bench.restartWith(std::nullopt, *count);
    }
}

void editStep(Workbench& bench) {
    SimulationConfig next = bench.config();
    std::array<float, 2> gravity = {float(next.step.gravity.x()), float(next.step.gravity.y())};
    bool changed = ImGui::DragFloat2("gravity", gravity.data(), 2, -100'000, 100'000, "%.4g",
                                     ImGuiSliderFlags_AlwaysClamp);
    tooltip("To the right and up, px/s\u00b2. Drag, or double-click to type.");
    if (changed) next.step.gravity = Vec2(double(gravity[0]), double(gravity[1]));
    auto restitution = float(next.step.restitution);
    const bool other =
        ImGui::SliderFloat("restitution", &restitution, 0, 1, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    tooltip("What a collision leaves of the speed of approach: 1 is elastic.");
    if (other) next.step.restitution = double(restitution);
    if (changed || other) bench.reconfigure(std::move(next));
}

}  // namespace

void showScenePanel(const PanelContext& context) {
    Workbench& bench = context.bench;
    if (!sectionHeader("Scene", "Where it starts, and the laws of its world.")) return;
    chooseScene(bench, context.scale);
    const std::string& about = bench.aboutScene();
    if (!about.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
        ImGui::TextWrapped("%s", about.c_str());
        ImGui::PopStyleColor();
    }
    if (bench.startsFromScene()) editStart(bench);
    editStep(bench);
}

}  // namespace quadrille::app
