#include <imgui.h>
#include <string>

#include <quadrille/names.hpp>

#include "app/window/panels.hpp"
#include "app/window/text.hpp"

namespace quadrille::app {

namespace {

/// A label, and its value at the right side of the column; the tooltip says what it counts.
void row(const char* label, const std::string& value, const char* meaning) {
    ImGui::BeginGroup();
    ImGui::TextDisabled("%s", label);
    const float width = ImGui::CalcTextSize(value.c_str()).x;
    ImGui::SameLine();
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - width);
    ImGui::TextUnformatted(value.c_str());
    ImGui::EndGroup();
    tooltip(meaning);
}

std::string runsOn(const RunSession& session) {
    const Simulation& simulation = session.simulation();
    const ResolverKind runs = simulation.config().resolver;
    const ResolverKind wanted = session.run().requestedResolver;
    std::string text(name(runs));
    if (simulation.threads() > 1) text += formatted(" (%d threads)", simulation.threads());
    if (wanted != runs && wanted != ResolverKind::Auto)
        text += ", not " + std::string(name(wanted));
    return text;
}

}  // namespace

void showCountersPanel(const PanelContext& context) {
    if (!sectionHeader("Counters", "Of the run so far, and of now.")) return;
    const RunSession& session = context.bench.session();
    const RunStatistics& total = session.statistics();
    const Simulation& simulation = session.simulation();
    const Measures& m = context.measures;
    const World& world = simulation.world();
    const StepReport& last = context.bench.lastStep();
    row("bodies", grouped(world.movingCount()) + " and " + grouped(world.staticCount()) + " static",
        "Moving bodies, and static ones.");
    row("step, time",
        grouped(simulation.stepsDone()) + ", " + formatted("%.2f s", simulation.time()),
        "Steps done, and the time of the simulation.");
    row("per second", formatted("%.0f steps, %.0f pictures", m.stepsPerSecond, m.picturesPerSecond),
        "Of wall time.");
    row("collisions",
        grouped(total.collisions()) + ", " + compact(m.collisionsPerSecond) + " per s",
        "Contacts that exchanged an impulse: since the start, and lately per second of the "
        "simulation.");
    row("contacts, pairs", grouped(last.contacts) + ", " + grouped(last.pairsTested) + " tested",
        "Of the last step: pairs that touched, and pairs whose boxes were compared. The law "
        "'continuous' compares only in steps in which it searches anew.");
    row("cells", grouped(m.load.cells) + ", " + grouped(m.load.activeCells) + " in use",
        "Of the partition, and those that hold a body.");
    row("bodies per cell",
        formatted("%.1f mean, ", m.load.meanBodies) + grouped(m.load.maxBodies) + " max",
        "Over the cells in use.");
    row("escaped", grouped(m.escaped), "Moving bodies whose centre is outside of the world.");
    row("deepest overlap", m.overlapKnown ? compact(m.deepestOverlap) + " px" : "not measured",
        "Of any two boxes now, along the axis along which it is least. Looked for as often as it "
        "takes a fiftieth of the time.");
    row("energy drift", formatted("%.2g", m.energyDrift),
        "Kinetic and potential energy over that of the start, minus 1.");
    row("missed pairs",
        simulation.config().countMissedPairs ? grouped(total.missedPairs()) : "not measured",
        "Pairs that overlapped and that the partition did not show; counted for the policy 'every "
        "K frames', and with --error.");
    row("runs on", runsOn(session), "The resolver that really runs.");
}

}  // namespace quadrille::app
