#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <quadrille/vec2.hpp>

namespace quadrille {

/// A row of an instance file.
struct Instance {
    Vec2 position{0, 0};  ///< px
    Vec2 velocity{0, 0};  ///< px/s
    Vec2 size{1, 1};      ///< px
    double mass = 1;
};

/// Of a spawn group or an instance file.
inline constexpr std::uint64_t mostBodies = 50'000'000;

/// Reads a CSV file with the header x,y,vx,vy[,w,h[,mass]]; rows without w,h or mass take those of
/// `defaults`. Throws SceneError, naming file, line and column, for anything else, and `place`,
/// which asks for the file, where all of it cannot be taken. `announce` is told the number of rows,
/// at most, before memory is taken for them, and may throw.
std::vector<Instance> readInstances(const std::filesystem::path& file, const Instance& defaults,
                                    const std::string& place,
                                    const std::function<void(std::uint64_t)>& announce);

}  // namespace quadrille
