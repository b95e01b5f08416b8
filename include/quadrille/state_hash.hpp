#pragma once

#include <cstdint>

#include <quadrille/world.hpp>

namespace quadrille {

/// 64 bits over the bits of position and velocity of all moving bodies in order of creation; -0
/// counts as 0. Word k of the state is mixed with its position k, and the results are added, so
/// that parts may be hashed in any order.
std::uint64_t stateHash(const World& world);

}  // namespace quadrille
