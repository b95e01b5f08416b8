#include "app/summary.hpp"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string_view>

namespace quadrille::app {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, showPhaseCount> showPhaseNames = {"gui", "prepare", "draw",
                                                                         "present"};

std::string hexadecimal(std::uint64_t value) {
    std::array<char, 17> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
    return text.data();
}

Json partitionerParameters(const PartitionerConfig& config) {
    return std::visit(
        []<class C>(const C& c) -> Json {
            if constexpr (std::is_same_v<C, StaticGrid>) {
                return {{"cell_size", {c.cellSize.x(), c.cellSize.y()}}};
            } else if constexpr (std::is_same_v<C, Quadtree>) {
                return {{"max_depth", c.maxDepth}, {"max_per_cell", c.maxPerCell}};
            } else if constexpr (std::is_same_v<C, SemiStaticQuadtree>) {
                Json result = {{"max_depth", c.maxDepth}, {"max_per_cell", c.maxPerCell}};
                if (const auto* every = std::get_if<SemiStaticQuadtree::EveryFrames>(&c.rebuild)) {
                    result["rebuild"] = "every:" + std::to_string(every->frames);
                } else {
                    const double width = std::get<SemiStaticQuadtree::Skin>(c.rebuild).width;
                    result["rebuild"] = "skin";
                    result["skin"] = width > 0 ? Json(width) : Json("auto");
                }
                return result;
            } else {
                static_assert(std::is_same_v<C, BruteForce>);
                return Json::object();
            }
        },
        config);
}

}  // namespace

std::string_view phaseName(std::size_t phase) {
    return phase < phaseCount ? name(static_cast<Phase>(phase))
                              : showPhaseNames[phase - phaseCount];
}

Conserved Conserved::of(const Simulation& simulation) {
    return {.kinetic = kineticEnergy(simulation.world()),
            .total = totalEnergy(simulation.world(), simulation.config().step.gravity),
            .momentum = quadrille::momentum(simulation.world())};
}

double relativeDrift(double start, double end) {
    if (start == end) return 0;
    return (end - start) / (start != 0 ? std::abs(start) : std::abs(end));
}

Json summaryJson(const Run& run, const RunStatistics& statistics, const Conserved& start) {
    const Simulation& simulation = run.simulation;
    const SimulationConfig& config = simulation.config();
    const World& world = simulation.world();
    const Conserved end = Conserved::of(simulation);
    const FrameTimes times = statistics.times();
    const CellLoad cells = loadOf(simulation.cells());
    Json json;
    json["scene"] = run.scene;
    json["seed"] = run.seed;
    json["entities"] = world.movingCount();
    json["static_entities"] = world.staticCount();
    json["frames"] = statistics.frames();
    json["steps_done"] = simulation.stepsDone();
    json["dt"] = config.step.dt;
    json["gravity"] = {config.step.gravity.x(), config.step.gravity.y()};
    json["restitution"] = config.step.restitution;
    json["law"] = name(config.law);
    json["precision"] = name(config.precision);
    json["partitioner"] = name(config.partitioner);
    json["partitioner_parameters"] = partitionerParameters(config.partitioner);
    json["resolver"] = name(config.resolver);
    json["requested_resolver"] = name(run.requestedResolver);
    json["threads"] = run.simulation.threads();
    json["device"] = needsDevice(config.resolver) ? Json(findCudaDevice().name) : Json(nullptr);
    json["ms_per_frame"] = {{"mean", times.mean}, {"median", times.median}, {"p99", times.p99}};
    if (config.profile) {
        const auto phases = statistics.phaseMilliseconds();
        Json& out = json["phases_ms"];
        for (std::size_t i = 0; i < phaseCount; ++i) out[std::string(phaseName(i))] = phases[i];
        if (statistics.shown && statistics.shown->pictures > 0) {
            for (std::size_t i = 0; i < showPhaseCount; ++i) {
                out[std::string(showPhaseNames[i])] =
                    1e3 * statistics.shown->seconds[i] / double(statistics.shown->pictures);
            }
        }
    } else {
        json["phases_ms"] = nullptr;
    }
    if (const auto& shown = statistics.shown) {
        json["window"] = {{"pictures", shown->pictures},
                          {"width", shown->width},
                          {"height", shown->height},
                          {"renderer", shown->renderer}};
    } else {
        json["window"] = nullptr;
    }
    json["cells"] = cells.cells;
    json["active_cells"] = cells.activeCells;
    json["max_bodies_per_cell"] = cells.maxBodies;
    json["mean_bodies_per_cell"] = cells.meanBodies;
    json["pairs_tested"] = statistics.pairsTested();
    json["contacts"] = statistics.contacts();
    json["collisions"] = statistics.collisions();
    json["missed_pairs"] = config.countMissedPairs ? Json(statistics.missedPairs()) : Json(nullptr);
    json["missed_pairs_frames"] =
        config.countMissedPairs ? Json(statistics.auditedFrames()) : Json(nullptr);
    json["rebuilds"] = statistics.rebuilds();
    json["frames_left_to_host"] = config.resolver == ResolverKind::CudaResident
                                      ? Json(statistics.leftToHost())
                                      : Json(nullptr);
    json["kinetic_energy"] = {{"start", start.kinetic},
                              {"end", end.kinetic},
                              {"relative_drift", relativeDrift(start.kinetic, end.kinetic)}};
    json["total_energy"] = {{"start", start.total},
                            {"end", end.total},
                            {"relative_drift", relativeDrift(start.total, end.total)}};
    json["momentum"] = {{"start", {start.momentum.x(), start.momentum.y()}},
                        {"end", {end.momentum.x(), end.momentum.y()}}};
    json["escaped"] = escaped(world);
    json["max_overlap"] = overlap(world).max;
    json["bytes_per_body"] = world.movingCount() == 0
                                 ? Json(nullptr)
                                 : Json(double(world.bytes() + simulation.workspaceBytes()) /
                                        double(world.movingCount()));
    json["state_hash"] = hexadecimal(stateHash(world));
    json["version"] = version;
    json["commit"] = commit();
    return json;
}

void printSummary(std::ostream& out, const Json& json) {
    const auto row = [&](const char* label, const std::string& value) {
        std::array<char, 24> padded{};
        std::snprintf(padded.data(), padded.size(), "  %-18s", label);
        out << padded.data() << value << '\n';
    };
    const auto number = [](const Json& value, const char* format) {
        std::array<char, 64> text{};
        std::snprintf(text.data(), text.size(), format, value.get<double>());
        return std::string(text.data());
    };
    const auto text = [](const Json& value) { return value.get<std::string>(); };

    out << "summary\n";
    row("scene", text(json["scene"]) + ", seed " + json["seed"].dump());
    row("entities",
        json["entities"].dump() + " moving, " + json["static_entities"].dump() + " static");
    row("run", json["frames"].dump() + " frames of " + number(json["dt"], "%.6g") + " s, law " +
                   text(json["law"]) + ", " + text(json["precision"]));
    std::string resolver = text(json["resolver"]);
    const std::string requested = text(json["requested_resolver"]);
    if (resolver == name(ResolverKind::Threads)) {
        resolver += " (" + json["threads"].dump() + " threads)";
    }
    if (requested != text(json["resolver"])) resolver += " (asked for: " + requested + ")";
    if (!json["device"].is_null()) resolver += " on " + text(json["device"]);
    row("partitioner", text(json["partitioner"]) + ", resolver " + resolver);
    const Json& ms = json["ms_per_frame"];
    row("ms per frame", number(ms["mean"], "%.4f mean, ") + number(ms["median"], "%.4f median, ") +
                            number(ms["p99"], "%.4f p99"));
    if (!json["phases_ms"].is_null()) {
        std::string phases;
        for (std::size_t i = 0; i < phaseCount + showPhaseCount; ++i) {
            const std::string key(phaseName(i));
            if (!json["phases_ms"].contains(key)) continue;
            phases +=
                (phases.empty() ? "" : ", ") + key + " " + number(json["phases_ms"][key], "%.4f");
        }
        row("phases, ms", phases);
    }
    row("cells", json["cells"].dump() + ", " + json["active_cells"].dump() +
                     " with bodies; bodies per cell " +
                     number(json["mean_bodies_per_cell"], "%.2f mean, ") +
                     json["max_bodies_per_cell"].dump() + " max");
    row("pairs", json["pairs_tested"].dump() + " tested, " + json["contacts"].dump() +
                     " contacts, " + json["collisions"].dump() + " collisions, " +
                     json["rebuilds"].dump() + " rebuilds");
    if (!json["frames_left_to_host"].is_null()) {
        row("left to the host", json["frames_left_to_host"].dump() + " of " +
                                    json["frames"].dump() + " frames, or the rest of them");
    }
    if (!json["missed_pairs"].is_null()) {
        row("missed pairs", json["missed_pairs"].dump() + " by the broad phase, in " +
                                json["missed_pairs_frames"].dump() + " frames looked at");
    }
    row("kinetic energy", number(json["kinetic_energy"]["end"], "%.9g, drift ") +
                              number(json["kinetic_energy"]["relative_drift"], "%.3g"));
    row("max overlap",
        number(json["max_overlap"], "%.6g px, ") + json["escaped"].dump() + " escaped");
    row("state hash", text(json["state_hash"]));
}

}  // namespace quadrille::app
