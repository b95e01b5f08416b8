#pragma once

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include <quadrille/simulation.hpp>

#include "collision/random_scene.hpp"
#include "collision/support.hpp"
#include "lockstep.hpp"

namespace quadrille {

/// What tests of whole scenes are run with.
struct CellsCase {
    std::string name;
    PartitionerConfig config;
};

struct SceneCase {
    std::string scene;
    std::optional<std::uint64_t> entities;
    std::uint64_t steps;
    double dt = 0;  ///< s; 0 is the scene's
};

inline std::ostream& operator<<(std::ostream& out, const CellsCase& c) { return out << c.name; }
inline std::ostream& operator<<(std::ostream& out, const SceneCase& c) {
    return out << c.scene << ", " << c.steps << " steps";
}

/// Shipped scenes in which the discrete laws have contacts soon.
inline const std::vector<SceneCase> scenesOfDiscreteLaws = {
    {"balanced", 3000, 40, 0.5}, {"imbalanced", 200, 20}, {"demo13k", 2000, 30, 0.1},
    {"mixed-sizes", 600, 30},    {"pile", 300, 60},       {"cradle", {}, 100}};

/// Runs a shipped scene with its step settings, as expectLockstep() does, and expects contacts.
inline void expectSceneInLockstep(const SceneCase& c, SimulationConfig config) {
    config.step = shippedScene(c.scene, c.entities).step;
    if (c.dt > 0) config.step.dt = c.dt;
    const std::uint64_t contacts =
        expectLockstep([&] { return shippedScene(c.scene, c.entities).world; }, config, c.steps);
    EXPECT_GT(contacts, 0u);
}

/// Words as the name of a test may have them.
inline std::string testName(std::string words) {
    std::replace(words.begin(), words.end(), '-', '_');
    return words;
}
inline std::string testNameOfKind(const testing::TestParamInfo<SceneKind>& test) {
    std::string words(name(test.param));
    std::erase_if(words, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
    return words;
}

}  // namespace quadrille
