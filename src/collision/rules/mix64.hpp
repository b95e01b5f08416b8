#pragma once

#include <cstdint>

#include <quadrille/detail/host_device.hpp>

namespace quadrille {

/// The finaliser of splitmix64 (Steele, Lea & Flood 2014): every bit of the input moves half of the
/// bits of the output.
QUADRILLE_HD inline std::uint64_t mix64(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

}  // namespace quadrille
