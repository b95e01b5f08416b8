#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/error.hpp>
#include <quadrille/scene.hpp>
#include <quadrille/simulation.hpp>

#include "fuzz/input.hpp"
#include "fuzz/short_run.hpp"

namespace quadrille::fuzz {

/// More bodies than that say nothing about what is read, and take long.
inline constexpr std::uint64_t mostBodiesOfRun = 200;

inline void requireSound(const World& world, const char* when) {
    const std::vector<std::string> findings = world.validate();
    if (!findings.empty()) throw Finding(std::string("unsound ") + when + ": " + findings.front());
}

/// The scene, or nothing if it is refused with a place in a file of the folder, or too large.
inline std::optional<Scene> load(const std::filesystem::path& file) {
    struct TooMany {};
    const auto announce = [](std::uint64_t bodies, std::optional<Law>) {
        if (bodies > mostBodiesOfRun) throw TooMany();
    };
    try {
        return loadScene(file, {.announce = announce});
    } catch (const TooMany&) {
        return std::nullopt;
    } catch (const SceneError& error) {
        static const std::regex place("^[^:]*:[0-9]+:[0-9]+: ");
        const std::string what = error.what();
        const std::string folder = file.parent_path().string();
        if (what.rfind(folder, 0) != 0 ||
            !std::regex_search(what, place, std::regex_constants::match_continuous)) {
            throw Finding("refused without file and place: " + what);
        }
        return std::nullopt;
    }
}

/// A scene that is loaded runs two steps, and is sound before and after.
inline bool loadsAndRuns(const std::filesystem::path& file, Precision precision) {
    std::optional<Scene> scene = load(file);
    if (!scene) return false;
    requireSound(scene->world, "when it is loaded");
    std::optional<Simulation> sim;
    try {
        sim.emplace(std::move(scene->world),
                    SimulationConfig{.law = scene->law.value_or(Law::Continuous),
                                     .precision = precision,
                                     .step = scene->step});
    } catch (const Error&) {
        if (precision == Precision::Float) return false;  // it need not fit
        throw;
    }
    if (isShort(*sim) && runs(*sim)) requireSound(sim->world(), "after two steps");
    return true;
}

/// As good as any choice, and the same for the same input.
inline Precision precisionFor(std::string_view input) {
    return input.size() % 2 == 0 ? Precision::Double : Precision::Float;
}

}  // namespace quadrille::fuzz
