#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <quadrille/world.hpp>

namespace quadrille {

/// How the bodies of a random scene lie.
enum class SceneKind : std::uint8_t {
    Uniform,
    Clustered,
    CellBorders,  ///< centres and edges exactly on borders of cells
    HugeAndTiny,  ///< from 1e-3 px to several worlds
    Outside,      ///< around the world and as far out as 1e9 px
    OnePoint,     ///< all centres at the same place
};

inline constexpr std::array sceneKinds = {SceneKind::Uniform,     SceneKind::Clustered,
                                          SceneKind::CellBorders, SceneKind::HugeAndTiny,
                                          SceneKind::Outside,     SceneKind::OnePoint};

std::string_view name(SceneKind kind);

/// A world of up to `most` bodies that depends on the seed alone: world size, count, whether sizes
/// differ and whether there are static bodies are drawn from it too. The count may be zero.
/// Velocities are uniform within +-`speed` on each axis.
World randomScene(SceneKind kind, std::uint64_t seed, int most = 120, double speed = 100);

}  // namespace quadrille
