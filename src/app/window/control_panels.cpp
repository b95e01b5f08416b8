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

/// What can be chosen, and what it is good for.
struct Choice {
    std::string name, about;
};

/// A list to choose from; true when another one was chosen.
bool choose(const char* label, int& chosen, std::span<const Choice> choices, const char* meaning) {
    bool changed = false;
    if (!ImGui::BeginCombo(label, choices[std::size_t(chosen)].name.c_str())) {
        tooltip(meaning);
        return false;
    }
    for (int i = 0; i < int(choices.size()); ++i) {
        const Choice& choice = choices[std::size_t(i)];
        if (ImGui::Selectable(choice.name.c_str(), i == chosen) && i != chosen) {
            chosen = i;
            changed = true;
        }
        if (!choice.about.empty()) tooltip(choice.about.c_str());
    }
    ImGui::EndCombo();
    return changed;
}

/// The same for things with names.
template <class Kind>
bool choose(const char* label, std::size_t& chosen, std::span<const Named<Kind>> all,
            const char* meaning) {
    std::vector<Choice> choices;
    for (const Named<Kind>& named : all) {
        choices.push_back({std::string(named.name), std::string(named.about)});
    }
    auto i = int(chosen);
    if (!choose(label, i, choices, meaning)) return false;
    chosen = std::size_t(i);
    return true;
}
template <class Kind>
bool chooseKind(const char* label, Kind& kind, std::span<const Named<Kind>> all,
                const char* meaning) {
    std::size_t i = 0;
    while (i < all.size() && all[i].kind != kind) ++i;
    if (!choose(label, i, all, meaning)) return false;
    kind = all[i].kind;
    return true;
}

/// What the chosen one is good for.
template <class Kind>
void showAbout(Kind kind, std::span<const Named<Kind>> all) {
    for (const Named<Kind>& named : all) {
        if (named.kind != kind) continue;
        ImGui::PushTextWrapPos();
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
        ImGui::TextUnformatted(named.about.data(), named.about.data() + named.about.size());
        ImGui::PopStyleColor();
        ImGui::PopTextWrapPos();
    }
}

bool button(const char* label, float width, const char* meaning) {
    const bool pressed = ImGui::Button(label, {width, 0});
    tooltip(meaning);
    return pressed;
}

bool checkbox(const char* label, bool& value, const char* meaning) {
    const bool changed = ImGui::Checkbox(label, &value);
    tooltip(meaning);
    return changed;
}

bool dragInt(const char* label, int& value, float perPixel, int least, int most,
             const char* meaning) {
    const bool changed =
        ImGui::DragInt(label, &value, perPixel, least, most, "%d", ImGuiSliderFlags_AlwaysClamp);
    tooltip(meaning);
    return changed;
}

bool editTree(int& maxDepth, int& maxPerCell) {
    const bool changed =
        dragInt("max depth", maxDepth, 0.1f, 0, 15, "Levels of the tree below its root.");
    return dragInt("max per cell", maxPerCell, 0.25f, 1, 1'000'000,
                   "Bodies in a leaf before it splits.") ||
           changed;
}

bool editRebuild(decltype(SemiStaticQuadtree::rebuild)& rebuild) {
    using Skin = SemiStaticQuadtree::Skin;
    using EveryFrames = SemiStaticQuadtree::EveryFrames;
    auto* skin = std::get_if<Skin>(&rebuild);
    auto* every = std::get_if<EveryFrames>(&rebuild);
    int policy = every != nullptr ? 2 : skin->width > 0 ? 1 : 0;
    static const std::array<Choice, 3> policies = {
        {{"skin, automatic", "Before a body leaves its inflated box, which is as wide as pays."},
         {"skin, fixed", "Before a body leaves its inflated box, which is so wide."},
         {"every K frames", "After so many steps; misses pairs."}}};
    if (choose("rebuild", policy, policies, "When the tree is built anew.")) {
        if (policy == 2) {
            rebuild = EveryFrames{};
        } else {
            rebuild = Skin{policy == 1 ? 2.0 : 0.0};
        }
        return true;
    }
    if (policy == 1) {
        auto width = float(skin->width);
        const bool changed = ImGui::DragFloat("skin, px", &width, 0.05f, 0.01f, 1000, "%.2f",
                                              ImGuiSliderFlags_AlwaysClamp);
        tooltip("By how much boxes are inflated, beside what a step needs.");
        if (!changed) return false;
        skin->width = width;
        return true;
    }
    return policy == 2 &&
           dragInt("frames", every->frames, 0.2f, 1, 1000, "Steps from tree to tree.");
}

bool editParameters(PartitionerConfig& config) {
    return std::visit(
        []<class C>(C& c) {
            if constexpr (std::is_same_v<C, StaticGrid>) {
                std::array<float, 2> size = {float(c.cellSize.x()), float(c.cellSize.y())};
                const bool changed =
                    ImGui::DragFloat2("cell size, px", size.data(), 0.25f, 1, 10'000, "%.1f",
                                      ImGuiSliderFlags_AlwaysClamp);
                tooltip("Width and height of a cell.");
                if (!changed) return false;
                c.cellSize = Vec2(size[0], size[1]);
                return true;
            } else if constexpr (std::is_same_v<C, Quadtree>) {
                return editTree(c.maxDepth, c.maxPerCell);
            } else if constexpr (std::is_same_v<C, SemiStaticQuadtree>) {
                const bool tree = editTree(c.maxDepth, c.maxPerCell);
                return editRebuild(c.rebuild) || tree;
            } else {
                static_assert(std::is_same_v<C, BruteForce>);
                return false;
            }
        },
        config);
}

}  // namespace

void showRunPanel(const PanelContext& context) {
    Workbench& bench = context.bench;
    if (!sectionHeader("Run",
                       "Time goes on in steps of equal length, however fast it is "
                       "shown.")) {
        return;
    }
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
    if (button(bench.paused() ? "Go on" : "Pause", width, "Space")) bench.togglePause();
    ImGui::SameLine();
    if (button("Step", width, "One step, then pause (. or N)")) bench.singleStep();
    ImGui::SameLine();
    if (button("Reset", width, "Start anew, with what is chosen below (R)")) bench.reset();
    if (ImGui::BeginCombo("speed", speedLabel(bench.speed()).c_str())) {
        for (const double speed : offeredSpeeds) {
            if (ImGui::Selectable(speedLabel(speed).c_str(), speed == bench.speed())) {
                bench.setSpeed(speed);
            }
        }
        ImGui::EndCombo();
    } else {
        tooltip("Seconds of the simulation per second; a slow machine falls behind. + and -");
    }
}

void showCollisionsPanel(const PanelContext& context) {
    if (!sectionHeader("Collisions",
                       "What a step is made with; a change takes effect with the "
                       "next.")) {
        return;
    }
    SimulationConfig next = context.bench.config();
    auto partitioner = next.partitioner.index();
    bool changed = choose("partitioner", partitioner, partitioners(),
                          "Which pairs are looked at: the result is the same. 1 to 4");
    if (changed) {
        next.partitioner = partitioners()[partitioner].kind;
    } else {
        changed = editParameters(next.partitioner);
    }
    changed = chooseKind("contact law", next.law, laws(), "What a contact does. L") || changed;
    showAbout(next.law, laws());
    changed = chooseKind("resolver", next.resolver, resolvers(),
                         "Who does it: the result is the same. T") ||
              changed;
    if (changed) context.bench.reconfigure(std::move(next));
}

void showDisplayPanel(const PanelContext& context) {
    ViewState& view = context.view;
    if (!sectionHeader("Display", "What is drawn, and how.")) return;
    auto colorBy = int(view.colorBy);
    std::vector<Choice> choices;
    for (const Named<ColorBy>& coloring : colorings()) {
        choices.push_back({std::string(coloring.about), {}});
    }
    if (choose("colour by", colorBy, choices, "What the colour of a body says. V")) {
        view.colorBy = static_cast<ColorBy>(colorBy);
    }
    const auto apart = float(14 * context.scale);
    checkbox("grid", view.overlays.gridlines, "Lines between the cells of the partition. G");
    ImGui::SameLine(0, apart);
    checkbox("heat", view.overlays.heatMap, "How many bodies each cell holds. M");
    ImGui::SameLine(0, apart);
    if (checkbox("contacts", view.overlays.contacts,
                 "Where boxes met in the last step, with the impulse along each axis. C")) {
        context.bench.watchContacts(view.overlays.contacts);
    }
    checkbox("velocities", view.overlays.arrows, "Arrows. A");
    ImGui::SameLine(0, apart);
    if (checkbox("trails", view.overlays.trails,
                 "Where the selected body was in the last two seconds, or without one all. W")) {
        context.bench.watchTrails(view.overlays.trails);
    }
    ImGui::SameLine(0, apart);
    checkbox("vsync", view.vsync, "Wait for the screen, so that pictures do not tear.");
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
    if (button("Show all", width, "Home or 0")) view.fit = true;
    ImGui::SameLine();
    if (button("Screenshot", width, "SCENE-STEP.png in the current folder. F12 or P")) {
        view.screenshot = true;
    }
    ImGui::SameLine();
    if (button("Help", width, "Keys and mouse. F1 or H")) view.help = !view.help;
}

}  // namespace quadrille::app
