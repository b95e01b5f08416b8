#include <algorithm>
#include <array>
#include <cmath>
#include <imgui.h>
#include <string>

#include <quadrille/names.hpp>

#include "app/summary.hpp"
#include "app/window/nice_numbers.hpp"
#include "app/window/panels.hpp"
#include "app/window/text.hpp"

namespace quadrille::app {

namespace {

/// A label, and its value at the right side of the column.
void row(const char* label, const std::string& value) {
    ImGui::TextDisabled("%s", label);
    const float width = ImGui::CalcTextSize(value.c_str()).x;
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
    ImGui::TextUnformatted(value.c_str());
}

/// Colours of the phases, from below in the plot.
ImU32 phaseColor(std::size_t phase) {
    constexpr ImU32 alpha = 0xff000000u;
    static constexpr std::array<ImU32, 10> colors = {0xc77f4a, 0x5ab4f2, 0x5c5cde, 0x9d9d9d,
                                                     0x55c8b8, 0x9acd50, 0x4fd0f0, 0xd28cf0,
                                                     0x7070b0, 0x909040};
    return alpha | colors[phase % colors.size()];
}

/// The name of a phase as a text has it: "copy to device".
std::string phaseWords(std::size_t phase) {
    std::string words(phaseName(phase));
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

constexpr std::size_t presentRow = PhaseHistory::rows - 1;

/// An empty rectangle as wide as the column, for a plot.
struct Canvas {
    ImVec2 low, high;
    ImDrawList& list;

    explicit Canvas(double height)
        : low(ImGui::GetCursorScreenPos()),
          high(low.x + ImGui::GetContentRegionAvail().x, low.y + float(height)),
          list(*ImGui::GetWindowDrawList()) {
        ImGui::Dummy({high.x - low.x, high.y - low.y});
        list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_FrameBg), 2);
    }
    float width() const { return high.x - low.x; }
    float height() const { return high.y - low.y; }
};

}  // namespace

void showCountersPanel(const PanelContext& context) {
    if (!sectionHeader("Counters")) return;
    const RunSession& session = context.bench.session();
    const Simulation& simulation = session.simulation();
    const SimulationConfig& config = simulation.config();
    const Measures& m = context.measures;
    const World& world = simulation.world();
    const StepReport& last = context.bench.lastStep();
    row("entities", grouped(world.movingCount()) + ", " + grouped(world.staticCount()) + " static");
    row("step, time",
        grouped(simulation.stepsDone()) + ", " + formatted("%.2f s", simulation.time()));
    row("per second",
        formatted("%.0f steps, %.0f pictures", m.stepsPerSecond, m.picturesPerSecond));
    row("cells", grouped(m.load.cells) + ", " + grouped(m.load.activeCells) + " in use");
    row("bodies per cell",
        formatted("%.1f mean, ", m.load.meanBodies) + grouped(m.load.maxBodies) + " max");
    // The law 'continuous' tests pairs only where it searches anew, which is not in every step.
    row("contacts", grouped(last.contacts));
    row("pairs tested", grouped(last.pairsTested));
    row("energy drift", formatted("%.2g", m.energyDrift));
    row("missed pairs", config.countMissedPairs ? grouped(session.statistics().missedPairs())
                                                : std::string("not measured"));
    const std::string resolver(name(config.resolver));
    const ResolverKind wanted = session.run().requestedResolver;
    std::string runs = resolver;
    if (simulation.threads() > 1) runs += formatted(" (%d threads)", simulation.threads());
    if (wanted != config.resolver && wanted != ResolverKind::Auto) {
        runs += ", not " + std::string(name(wanted));
    }
    row("runs on", runs);
}

void showFrameTimePanel(const PanelContext& context) {
    if (!sectionHeader("Frame time")) return;
    const PhaseHistory& history = context.history;
    const PhaseHistory::Row mean = history.mean();
    float most = 0;
    // Waiting for the screen is not work.
    const auto total = [](const PhaseHistory::Row& row) {
        float sum = 0;
        for (std::size_t k = 0; k < presentRow; ++k) sum += row[k];
        return sum;
    };
    for (std::size_t i = 0; i < history.size(); ++i) most = std::max(most, total(history[i]));
    const auto top = float(std::max(niceCeiling(double(most)), 1e-3));
    const Canvas canvas(50 * context.scale);
    const float barWidth = canvas.width() / float(PhaseHistory::length);
    for (std::size_t i = 0; i < history.size(); ++i) {
        const float x = canvas.high.x - float(history.size() - i) * barWidth;
        float y = canvas.high.y;
        for (std::size_t k = 0; k < presentRow; ++k) {
            const float height = history[i][k] / top * canvas.height();
            if (height <= 0) continue;
            canvas.list.AddRectFilled({x, y - height}, {x + barWidth, y}, phaseColor(k));
            y -= height;
        }
    }
    canvas.list.AddText({canvas.low.x + 4, canvas.low.y + 1}, ImGui::GetColorU32(ImGuiCol_Text),
                        formatted("%g ms", double(top)).c_str());
    if (ImGui::BeginTable("phases", 2)) {
        for (std::size_t k = 0; k < PhaseHistory::rows; ++k) {
            if (k < phaseCount && mean[k] == 0) continue;  // as copies where there is no device
            ImGui::TableNextColumn();
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float side = ImGui::GetFontSize() * 0.6f;
            const float drop = (ImGui::GetFontSize() - side) / 2;
            if (k != presentRow) {
                ImGui::GetWindowDrawList()->AddRectFilled(
                    {at.x, at.y + drop}, {at.x + side, at.y + drop + side}, phaseColor(k));
            }
            ImGui::SetCursorScreenPos({at.x + side + 5, at.y});
            ImGui::TextDisabled("%s", phaseWords(k).c_str());
            const std::string value = formatted("%.2f", double(mean[k]));
            ImGui::SameLine(0, 0);
            const float room = ImGui::GetContentRegionAvail().x;
            ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room -
                                 ImGui::CalcTextSize(value.c_str()).x);
            ImGui::TextUnformatted(value.c_str());
        }
        ImGui::EndTable();
    }
}

void showLoadPanel(const PanelContext& context) {
    if (!sectionHeader("Bodies per cell")) return;
    const LoadHistogram& histogram = context.measures.histogram;
    const Canvas canvas(50 * context.scale);
    const std::size_t bins = histogram.cells.size();
    if (bins == 0 || histogram.most == 0) return;
    const auto scaled = [](std::size_t count) { return std::log1p(float(count)); };
    const float barWidth = canvas.width() / float(bins);
    for (std::size_t k = 0; k < bins; ++k) {
        const float height = scaled(histogram.cells[k]) / scaled(histogram.most) *
                             (canvas.height() - ImGui::GetFontSize() - 5);
        const float x = canvas.low.x + float(k) * barWidth;
        canvas.list.AddRectFilled({x + 0.5f, canvas.high.y - height},
                                  {x + barWidth - 0.5f, canvas.high.y}, 0xffdb9d4f);
    }
    canvas.list.AddText({canvas.low.x + 4, canvas.low.y + 1}, ImGui::GetColorU32(ImGuiCol_Text),
                        (grouped(histogram.most) + " cells, log").c_str());
    const std::string range = "0 to " + grouped(bins * histogram.binWidth - 1) + " bodies";
    canvas.list.AddText(
        {canvas.high.x - 4 - ImGui::CalcTextSize(range.c_str()).x, canvas.low.y + 1},
        ImGui::GetColorU32(ImGuiCol_TextDisabled), range.c_str());
}

}  // namespace quadrille::app
