#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <quadrille/scene.hpp>

namespace quadrille::bench {

/// Loads a shipped scene, or a file; `entities` replaces the count of its first spawn group. Throws
/// Error, with the shipped names, if there is neither.
Scene openScene(const std::string& nameOrFile, std::optional<std::uint64_t> entities = {});

/// The names of the shipped scenes, sorted.
std::vector<std::string> shippedScenes();

}  // namespace quadrille::bench
