#include <array>
#include <imgui.h>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <quadrille/names.hpp>

#include "app/window/panels.hpp"
#include "app/window/text.hpp"

namespace quadrille::app {

namespace {

/// A list of names to choose from; true when another one was chosen.
template <class Names>
bool choose(const char* label, int& chosen, const Names& names) {
    bool changed = false;
    if (!ImGui::BeginCombo(label, std::string(names[std::size_t(chosen)]).c_str())) return false;
    for (int i = 0; i < int(std::size(names)); ++i) {
        if (ImGui::Selectable(std::string(names[std::size_t(i)]).c_str(), i == chosen) &&
            i != chosen) {
            chosen = i;
            changed = true;
        }
    }
    ImGui::EndCombo();
    return changed;
}

/// The same for things with names.
template <class Kind>
bool choose(const char* label, std::size_t& chosen, std::span<const Named<Kind>> all) {
    std::vector<std::string_view> names;
    for (const Named<Kind>& named : all) names.push_back(named.name);
    auto i = int(chosen);
    if (!choose(label, i, names)) return false;
    chosen = std::size_t(i);
    return true;
}
template <class Kind>
bool chooseKind(const char* label, Kind& kind, std::span<const Named<Kind>> all) {
    std::size_t i = 0;
    while (i < all.size() && all[i].kind != kind) ++i;
    if (!choose(label, i, all)) return false;
    kind = all[i].kind;
    return true;
}

/// What the law is good for.
void showMeaning(Law law) {
    for (const Named<Law>& named : laws()) {
        if (named.kind != law) continue;
        ImGui::PushTextWrapPos();
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
        ImGui::TextUnformatted(named.about.data(), named.about.data() + named.about.size());
        ImGui::PopStyleColor();
        ImGui::PopTextWrapPos();
    }
}

bool dragInt(const char* label, int& value, float perPixel, int least, int most) {
    return ImGui::DragInt(label, &value, perPixel, least, most, "%d", ImGuiSliderFlags_AlwaysClamp);
}

bool editTree(int& maxDepth, int& maxPerCell) {
    const bool changed = dragInt("max depth", maxDepth, 0.1f, 0, 15);
    return dragInt("max per cell", maxPerCell, 0.25f, 1, 1'000'000) || changed;
}

bool editRebuild(decltype(SemiStaticQuadtree::rebuild)& rebuild) {
    using Skin = SemiStaticQuadtree::Skin;
    using EveryFrames = SemiStaticQuadtree::EveryFrames;
    auto* skin = std::get_if<Skin>(&rebuild);
    auto* every = std::get_if<EveryFrames>(&rebuild);
    int policy = every != nullptr ? 2 : skin->width > 0 ? 1 : 0;
    if (choose("rebuild", policy, std::array{"skin, automatic", "skin, fixed", "every K frames"})) {
        if (policy == 2) {
            rebuild = EveryFrames{};
        } else {
            rebuild = Skin{policy == 1 ? 2.0 : 0.0};
        }
        return true;
    }
    if (policy == 1) {
        auto width = float(skin->width);
        if (!ImGui::DragFloat("skin, px", &width, 0.05f, 0.01f, 1000, "%.2f",
                              ImGuiSliderFlags_AlwaysClamp)) {
            return false;
        }
        skin->width = width;
        return true;
    }
    return policy == 2 && dragInt("frames", every->frames, 0.2f, 1, 1000);
}

bool editParameters(PartitionerConfig& config) {
    return std::visit(
        []<class C>(C& c) {
            if constexpr (std::is_same_v<C, StaticGrid>) {
                std::array<float, 2> size = {float(c.cellSize.x()), float(c.cellSize.y())};
                if (!ImGui::DragFloat2("cell size, px", size.data(), 0.25f, 1, 10'000, "%.1f",
                                       ImGuiSliderFlags_AlwaysClamp)) {
                    return false;
                }
                c.cellSize = Vec2(size[0], size[1]);
                return true;
            } else if constexpr (std::is_same_v<C, Quadtree>) {
                return editTree(c.maxDepth, c.maxPerCell);
            } else if constexpr (std::is_same_v<C, SemiStaticQuadtree>) {
                const bool tree = editTree(c.maxDepth, c.maxPerCell);
                return editRebuild(c.rebuild) || tree;
            } else {
                return false;
            }
        },
        config);
}

}  // namespace

void showRunPanel(const PanelContext& context) {
    Workbench& bench = context.bench;
    const std::string title = "Run: " + bench.session().run().scene + "###run";
    if (!sectionHeader(title.c_str())) return;
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
    if (ImGui::Button(bench.paused() ? "Go on" : "Pause", {width, 0})) bench.togglePause();
    ImGui::SameLine();
    if (ImGui::Button("Step", {width, 0})) bench.singleStep();
    ImGui::SameLine();
    if (ImGui::Button("Reset", {width, 0})) bench.reset();
    if (ImGui::BeginCombo("speed", speedLabel(bench.speed()).c_str())) {
        for (const double speed : offeredSpeeds) {
            if (ImGui::Selectable(speedLabel(speed).c_str(), speed == bench.speed())) {
                bench.setSpeed(speed);
            }
        }
        ImGui::EndCombo();
    }
}

void showCollisionsPanel(const PanelContext& context) {
    if (!sectionHeader("Collisions")) return;
    SimulationConfig next = context.bench.config();
    auto partitioner = next.partitioner.index();
    bool changed = choose("partitioner", partitioner, partitioners());
    if (changed) {
        next.partitioner = partitioners()[partitioner].kind;
    } else {
        changed = editParameters(next.partitioner);
    }
    changed = chooseKind("contact law", next.law, laws()) || changed;
    showMeaning(next.law);
    changed = chooseKind("resolver", next.resolver, resolvers()) || changed;
    if (changed) context.bench.reconfigure(std::move(next));
}

void showDisplayPanel(const PanelContext& context) {
    ViewState& view = context.view;
    if (!sectionHeader("Display")) return;
    auto colorBy = int(view.colorBy);
    std::vector<std::string_view> meanings;
    for (const Named<ColorBy>& coloring : colorings()) meanings.push_back(coloring.about);
    if (choose("colour by", colorBy, meanings)) view.colorBy = static_cast<ColorBy>(colorBy);
    const auto apart = float(14 * context.scale);
    ImGui::Checkbox("grid", &view.overlays.gridlines);
    ImGui::SameLine(0, apart);
    ImGui::Checkbox("heat", &view.overlays.heatMap);
    ImGui::SameLine(0, apart);
    if (ImGui::Checkbox("contacts", &view.overlays.contacts)) {
        context.bench.watchContacts(view.overlays.contacts);
    }
    ImGui::Checkbox("velocities", &view.overlays.arrows);
    ImGui::SameLine(0, apart);
    ImGui::Checkbox("vsync", &view.vsync);
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
    if (ImGui::Button("Show all", {width, 0})) view.fit = true;
    ImGui::SameLine();
    if (ImGui::Button("Screenshot", {width, 0})) view.screenshot = true;
    ImGui::SameLine();
    if (ImGui::Button("Help", {width, 0})) view.help = !view.help;
}

}  // namespace quadrille::app
