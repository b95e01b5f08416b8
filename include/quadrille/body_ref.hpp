#pragma once

#include <cstdint>

#include <quadrille/detail/host_device.hpp>

namespace quadrille {

/// A body in 32 bits: a row of the moving bodies, or a row of the static ones. Everything that may
/// name either kind (cells, pairs, contacts, events) holds one of these.
///
/// Moving bodies compare before static ones.
struct BodyRef {
    static constexpr std::uint32_t staticBit = 0x8000'0000u;
    /// Rows that can be told apart, of each kind. The last one is kept free, so that all bits set
    /// are no body.
    static constexpr std::uint32_t mostRows = staticBit - 1;

    std::uint32_t bits = 0xffff'ffffu;

    QUADRILLE_HD static constexpr BodyRef moving(std::uint32_t row) { return {row}; }
    QUADRILLE_HD static constexpr BodyRef fixed(std::uint32_t row) { return {row | staticBit}; }

    QUADRILLE_HD constexpr bool isStatic() const { return (bits & staticBit) != 0; }
    QUADRILLE_HD constexpr std::uint32_t row() const { return bits & ~staticBit; }

    QUADRILLE_HD friend constexpr bool operator==(BodyRef p, BodyRef q) { return p.bits == q.bits; }
    QUADRILLE_HD friend constexpr bool operator<(BodyRef p, BodyRef q) { return p.bits < q.bits; }
};

}  // namespace quadrille
