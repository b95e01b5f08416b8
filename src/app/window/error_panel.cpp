#include <algorithm>
#include <array>
#include <imgui.h>
#include <string>

#include "app/window/error_history.hpp"
#include "app/window/panels.hpp"
#include "app/window/plot_canvas.hpp"
#include "app/window/text.hpp"
#include "app/window/theme.hpp"

namespace quadrille::app {

namespace {

using Sample = ErrorHistory::Sample;

struct Line {
    const char* name;
    const char* meaning;
    Color color;
    double Sample::*value;
};

constexpr std::array<Line, 3> lines = {
    {{"collisions found",
      "Of the exact collisions, those that this run has, within two steps.",
      {130, 214, 150},
      &Sample::found},
     {"collisions real",
      "Of this run's collisions, those that the exact run has.",
      {110, 180, 245},
      &Sample::real},
     {"wrong bodies",
      "Bodies whose velocity is not the exact one now.",
      {255, 150, 128},
      &Sample::wrongBodies}}};

std::string percent(double share) { return formatted("%.4g %%", 100 * share); }

void drawLine(const PlotCanvas& canvas, const ErrorHistory& errors, const Line& line) {
    const auto& samples = errors.samples();
    const double end = samples.back().time;
    const auto point = [&](const Sample& sample) {
        const auto x = static_cast<float>(end > 0 ? sample.time / end : 1);
        return ImVec2(canvas.left() + x * canvas.width(),
                      canvas.bottom() - static_cast<float>(sample.*line.value) * canvas.height());
    };
    for (std::size_t i = 1; i < samples.size(); ++i) {
        canvas.list().AddLine(point(samples[i - 1]), point(samples[i]), packed(line.color), 1.5f);
    }
}

void showValues(const Sample& sample) {
    for (const Line& line : lines) {
        ImGui::BeginGroup();
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float side = ImGui::GetFontSize() * 0.6f;
        const float drop = (ImGui::GetFontSize() - side) / 2;
        ImGui::GetWindowDrawList()->AddRectFilled(
            {at.x, at.y + drop}, {at.x + side, at.y + drop + side}, packed(line.color), 2);
        ImGui::SetCursorScreenPos({at.x + side + 5, at.y});
        ImGui::TextDisabled("%s", line.name);
        const std::string value = percent(sample.*line.value);
        ImGui::SameLine();
        ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x -
                             ImGui::CalcTextSize(value.c_str()).x);
        ImGui::TextUnformatted(value.c_str());
        ImGui::EndGroup();
        tooltip(line.meaning);
    }
}

}  // namespace

void showErrorPanel(const PanelContext& context) {
    if (!context.bench.session().measuresError()) return;
    if (!sectionHeader("Error",
                       "How far the run is from the exact one, which an event-driven "
                       "reference computes beside it.")) {
        return;
    }
    const ErrorHistory& errors = context.errors;
    PlotCanvas canvas("error", float(64 * context.scale), "100 %");
    canvas.addLine(0, "0");
    canvas.addLine(0.5f, "50");
    canvas.addLine(1, "100 %");
    if (errors.samples().empty()) {
        canvas.addCaption("nothing before the first step");
    } else {
        for (const Line& line : lines) drawLine(canvas, errors, line);
        const Sample* shown = &errors.samples().back();
        if (const auto mouse = canvas.mouse()) {
            const double time = double(*mouse) * shown->time;
            shown = &*std::min_element(errors.samples().begin(), errors.samples().end(),
                                       [&](const Sample& a, const Sample& b) {
                                           return std::abs(a.time - time) < std::abs(b.time - time);
                                       });
            ImGui::SetTooltip("at %.2f s: %s found, %s real, %s of the bodies wrong", shown->time,
                              percent(shown->found).c_str(), percent(shown->real).c_str(),
                              percent(shown->wrongBodies).c_str());
        }
        showValues(errors.samples().back());
    }
    if (!errors.failure().empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text,
                              ImGui::ColorConvertU32ToFloat4(packed(theme.errorText)));
        ImGui::TextWrapped("%s", errors.failure().c_str());
        ImGui::PopStyleColor();
    }
}

}  // namespace quadrille::app
