#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace quadrille {

/// Pairs are compared in blocks of as many as the widest vector registers hold, and the result is a
/// bit for each: a loop of fixed length without branches, which compilers turn into vector code.
template <class Real>
inline constexpr std::size_t hitBlock = 64 / sizeof(Real);

template <class Real>
using HitBits = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;

/// Bit l is `hit(l)`, for l below the length of a block.
template <class Real, class Hit>
inline HitBits<Real> hitBits(Hit&& hit) {
    HitBits<Real> bits = 0;
// GCC would unroll the loop before it looks for vectors in it.
#pragma GCC unroll 1
    for (std::size_t l = 0; l < hitBlock<Real>; ++l) {
        const HitBits<Real> bit = hit(l);
        bits |= bit << l;
    }
    return bits;
}

/// Calls `function(l)` for each bit l that is set, from the lowest up.
template <class Bits, class Function>
inline void forEachBit(Bits bits, Function&& function) {
    for (; bits != 0; bits &= bits - 1) function(static_cast<std::size_t>(std::countr_zero(bits)));
}

}  // namespace quadrille
