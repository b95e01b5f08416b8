#pragma once

#include <compare>
#include <cstdint>
#include <limits>

namespace quadrille {

/// An id with a generation: the index is used again after the entity is destroyed, the pair never.
struct Entity {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t index = none;
    std::uint32_t generation = 0;

    friend auto operator<=>(const Entity&, const Entity&) = default;
};

}  // namespace quadrille
