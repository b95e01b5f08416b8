#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <quadrille/config.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/world.hpp>

namespace quadrille {

struct SceneOptions {
    /// Each "key=value" replaces what the file says, or adds to it, before anything of it is read:
    /// "step.restitution=0.5", "spawn.0.count=1000" (lists count from 0). The value is TOML, or
    /// text without quotes: "step.law=impulse". Later ones go before earlier ones. Errors are those
    /// of the file, with "--set" in place of file, line and column.
    std::vector<std::string> set = {};
    std::optional<std::uint64_t> entities = {};  ///< replaces the count of the first spawn group
    std::optional<std::uint64_t> seed = {};      ///< replaces the scene's
    bool renderers = false;                      ///< give the bodies a RectangleRenderer
    /// Told how many moving bodies there will be, at least, before memory is taken for them, and
    /// the law that the scene names; what it throws ends the loading.
    std::function<void(std::uint64_t movingBodies, std::optional<Law> law)> announce = {};
};

/// A scene that is ready to run.
struct Scene {
    std::string name;
    std::uint64_t seed = 1;
    World world;
    StepSettings step;
    std::optional<Law> law = {};                ///< that the scene names
    std::optional<std::uint64_t> spawned = {};  ///< count of the first spawn group
};

/// Reads a scene file (TOML; docs/scenes.md describes the format) and makes its bodies: walls,
/// spawn groups, single bodies, instances, each in the order of the file.
/// Throws SceneError, naming file, line, column and key, for anything that it cannot take.
Scene loadScene(const std::filesystem::path& file, const SceneOptions& options = {});

}  // namespace quadrille
