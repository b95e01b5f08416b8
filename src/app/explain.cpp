#include "app/explain.hpp"

#include <array>
#include <cstdio>
#include <ostream>
#include <string>
#include <string_view>
#include <variant>

#include <quadrille/names.hpp>

#include "app/memory_need.hpp"
#include "app/scene_catalog.hpp"
#include "system/memory.hpp"

namespace quadrille::app {

namespace {

void row(std::ostream& out, bool modelled, const std::string& what, const std::string& how) {
    std::array<char, 160> line{};
    std::snprintf(line.data(), line.size(), "  %-3s  %-22s %s\n", modelled ? "yes" : "no",
                  what.c_str(), how.c_str());
    out << line.data();
}

std::string_view aboutOf(Law law) {
    for (const auto& named : laws()) {
        if (named.kind == law) return named.about;
    }
    return "";
}

/// Which steps a resolver that keeps the bodies on a device leaves to the host.
std::string stepsOfHost(const SimulationConfig& config) {
    const bool exact = config.law == Law::Continuous;
    if (!staysOnDevice(config.law, config.step)) {
        return "all: with gravity or loss, this law does not run on the device";
    }
    std::string left = exact ? "the first, those after edits, and too crowded ones" : "";
    if (config.countMissedPairs) {
        left += std::string(left.empty() ? "" : "; ") + "those whose missed pairs are counted";
    }
    return left;
}

/// What of a step that runs on the device, and what of it costs a copy to the host.
void explainResident(std::ostream& out, const SimulationConfig& config, const ModelFeatures& f,
                     bool window) {
    const bool named = std::holds_alternative<StaticGrid>(config.partitioner);
    row(out, named, "cells as named",
        named ? "" : "a grid on the device stands in; the result is the same");
    const bool read = f.listeners || window;
    row(out, read, "bodies read each step",
        read ? "positions and velocities are copied to the host" : "they stay on the device");
    const std::string left = stepsOfHost(config);
    row(out, !left.empty(), "steps on the host", left);
}

}  // namespace

void explain(std::ostream& out, const Run& run, bool window) {
    const Simulation& simulation = run.simulation;
    const SimulationConfig& config = simulation.config();
    const World& world = simulation.world();
    const ModelFeatures f = simulation.features();
    const std::size_t real = config.precision == Precision::Double ? 8 : 4;
    const auto column = [&](std::size_t count) {
        return std::to_string(count * real) + " bytes a body";
    };
    std::string elsewhere;
    for (const auto& resolver : resolvers()) {
        const bool runs = resolver.kind != ResolverKind::Auto && runsOn(config.law, resolver.kind);
        if (runs) elsewhere += (elsewhere.empty() ? "" : ", ") + std::string(resolver.name);
    }
    out << "scene " << run.scene << ": " << world.movingCount() << " moving and "
        << world.staticCount() << " static bodies, law " << name(config.law) << ", "
        << name(config.precision) << ", " << name(config.partitioner) << ", resolver "
        << name(config.resolver) << '\n';
    out << "law " << name(config.law) << ": " << aboutOf(config.law) << "; it runs on " << elsewhere
        << '\n';
    row(out, f.movingBodies, "position and velocity", column(4));
    row(out, f.sizesDiffer, "sizes of their own", f.sizesDiffer ? column(2) : "one size for all");
    row(out, f.massesDiffer, "masses of their own",
        f.massesDiffer ? column(1) : "one mass for all");
    row(out, f.staticBodies, "static bodies",
        f.staticBodies ? "" : "no pair is tested against one");
    row(out, f.gravity, "gravity", f.gravity ? "" : "velocities change in contacts only");
    row(out, f.inelastic, "restitution below 1",
        f.inelastic      ? ""
        : f.massesDiffer ? ""
                         : "equal masses swap their velocities");
    row(out, f.listeners, "contact listeners", f.listeners ? "" : "no list of events is made");
    if (config.resolver == ResolverKind::CudaResident) explainResident(out, config, f, window);
    const bool profile = f.profile || window;
    row(out, profile, "profile", profile ? "" : "no clock is read inside a step");
    row(out, window, "renderer",
        window ? "a colour for each body" : "headless: no colours are stored");
    if (world.movingCount() > 0) {
        std::array<char, 128> line{};
        std::snprintf(
            line.data(), line.size(),
            "  %.1f bytes a body in the world, %.1f in work space before the first step\n",
            double(world.bytes()) / double(world.movingCount()),
            double(simulation.workspaceBytes()) / double(world.movingCount()));
        out << line.data();
        const std::uint64_t need = memoryNeed(config, world.movingCount(), window);
        std::snprintf(line.data(), line.size(),
                      "  about %.0f bytes a body once it runs, more in a crowd: %s of %s\n",
                      double(need) / double(world.movingCount()), inUnits(need).c_str(),
                      inUnits(memoryOfMachine()).c_str());
        out << line.data();
    }
}

void list(std::ostream& out) {
    out << "scenes:";
    for (const std::string& scene : sceneNames()) out << ' ' << scene;
    const auto names = [&](const char* what, const auto& all) {
        out << '\n' << what << ':';
        for (const auto& named : all) out << ' ' << named.name;
    };
    names("partitioners", partitioners());
    names("resolvers", resolvers());
    names("laws", laws());
    names("precisions", precisions());
    out << '\n';
}

}  // namespace quadrille::app
