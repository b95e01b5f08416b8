#include <algorithm>
#include <array>
#include <cmath>
#include <imgui.h>
#include <string>
#include <vector>

#include "app/window/nice_numbers.hpp"
#include "app/window/panels.hpp"
#include "app/window/plot_canvas.hpp"
#include "app/window/text.hpp"
#include "app/window/theme.hpp"

namespace quadrille::app {

namespace {

/// From below in the plot.
constexpr std::array<Color, PhaseHistory::rows> colors = {{{74, 127, 199},
                                                           {242, 180, 90},
                                                           {222, 92, 92},
                                                           {157, 157, 157},
                                                           {184, 200, 85},
                                                           {80, 205, 154},
                                                           {240, 208, 79},
                                                           {240, 140, 210},
                                                           {176, 112, 112},
                                                           {64, 160, 150},
                                                           {},
                                                           {150, 120, 230},
                                                           {110, 120, 132},
                                                           {}}};

float workOf(const PhaseHistory::Row& row) {
    float sum = 0;
    for (std::size_t k = 0; k < PhaseHistory::rows; ++k) sum += isWork(k) ? row[k] : 0;
    return sum;
}

/// The end of the axis, ms: one picture in twenty may be beyond, so that a single slow one does not
/// press all others down.
double topOf(const PhaseHistory& history) {
    std::vector<float> work;
    for (std::size_t i = 0; i < history.size(); ++i) work.push_back(workOf(history[i]));
    return std::max(niceCeiling(percentile(work, 0.95)), 0.1);
}

void drawBar(const PlotCanvas& canvas, const PhaseHistory::Row& row, float x, float width,
             float perMillisecond) {
    float y = canvas.bottom();
    const float ceiling = canvas.bottom() - canvas.height();
    for (std::size_t k = 0; k < PhaseHistory::rows; ++k) {
        if (!isWork(k) || row[k] <= 0) continue;
        const float next = std::max(y - row[k] * perMillisecond, ceiling);
        canvas.list().AddRectFilled({x, next}, {x + width, y}, packed(colors[k]));
        y = next;
    }
    if (workOf(row) * perMillisecond > canvas.height()) {
        canvas.list().AddRectFilled({x, ceiling}, {x + width, ceiling + 2},
                                    packed(theme.errorText));
    }
}

void swatch(std::size_t row) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = ImGui::GetFontSize() * 0.6f;
    const float drop = (ImGui::GetFontSize() - side) / 2;
    if (isWork(row)) {
        ImGui::GetWindowDrawList()->AddRectFilled(
            {at.x, at.y + drop}, {at.x + side, at.y + drop + side}, packed(colors[row]), 2);
    }
    ImGui::SetCursorScreenPos({at.x + side + 5, at.y});
}

/// One line for each row that can occur: its colour, its name, and the ms of `values`.
void table(const char* id, const PhaseHistory::Row& values, const PanelContext& context,
           int columns) {
    if (!ImGui::BeginTable(id, columns)) return;
    const ResolverKind resolver = context.bench.config().resolver;
    const bool error = context.bench.session().measuresError();
    for (std::size_t k = 0; k < PhaseHistory::rows; ++k) {
        if (!canOccur(k, resolver, error)) continue;
        ImGui::TableNextColumn();
        swatch(k);
        ImGui::TextDisabled("%s", phaseWords(k));
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", phaseMeaning(k));
        const std::string value = formatted("%.2f", double(values[k]));
        ImGui::SameLine(0, 0);
        const float room = ImGui::GetContentRegionAvail().x;
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - ImGui::CalcTextSize(value.c_str()).x);
        ImGui::TextUnformatted(value.c_str());
    }
    ImGui::EndTable();
}

}  // namespace

void showFrameTimePanel(const PanelContext& context) {
    if (!sectionHeader("Frame time",
                       "What the last pictures cost, by phase, in ms: the plot "
                       "without waiting, the numbers below as means.")) {
        return;
    }
    const PhaseHistory& history = context.history;
    const double top = topOf(history);
    PlotCanvas canvas("frame time", float(64 * context.scale), compact(top) + " ms");
    canvas.addLine(0, "0");
    canvas.addLine(0.5f, compact(top / 2));
    canvas.addLine(1, compact(top) + " ms");
    const float width = canvas.width() / float(PhaseHistory::length);
    const float perMillisecond = canvas.height() / float(top);
    const std::size_t missing = PhaseHistory::length - history.size();
    for (std::size_t i = 0; i < history.size(); ++i) {
        const float x = canvas.left() + float(missing + i) * width;
        drawBar(canvas, history[i], x, width, perMillisecond);
    }
    if (const auto mouse = canvas.mouse()) {
        const auto place = static_cast<std::size_t>(*mouse * float(PhaseHistory::length));
        if (place >= missing && place < PhaseHistory::length) {
            const float x = canvas.left() + (float(place) + 0.5f) * width;
            canvas.list().AddLine({x, canvas.bottom() - canvas.height()}, {x, canvas.bottom()},
                                  packed(theme.text));
            const PhaseHistory::Row& row = history[place - missing];
            ImGui::BeginTooltip();
            ImGui::Text("%zu pictures ago: %.2f ms of work", PhaseHistory::length - 1 - place,
                        double(workOf(row)));
            ImGui::Dummy({float(180 * context.scale), 0});
            table("of one", row, context, 1);
            ImGui::EndTooltip();
        }
    }
    table("means", history.mean(), context, 2);
}

}  // namespace quadrille::app
