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

/// Breaks ties between contacts of the same time. A hash and not the ids themselves: ids that rise
/// along a row of touching bodies would chain all their contacts one behind the other, which leaves
/// nothing to do in parallel (Blelloch, Fineman, Gibbons & Shun 2012).
QUADRILLE_HD inline std::uint32_t pairPriority(std::uint32_t entityA, std::uint32_t entityB) {
    return static_cast<std::uint32_t>(mix64((std::uint64_t(entityA) << 32) | entityB) >> 32);
}

/// A contact to be resolved by the law `impulse`.
template <class Real>
struct PendingContact {
    static constexpr std::uint32_t staticBit = 0x8000'0000u;

    Real sinceStart;         ///< s from the start of the step to the impact; the first key
    std::uint32_t priority;  ///< the second key
    std::uint32_t a;         ///< row of the moving body that was created first; the third key
    std::uint32_t b;         ///< row of the other, with staticBit for a static one; the last key
    std::uint8_t axes;
    std::uint8_t overlapBefore;
    std::int8_t senseX, senseY;
};

template <class Real>
QUADRILLE_HD inline bool isStatic(const PendingContact<Real>& c) {
    return (c.b & PendingContact<Real>::staticBit) != 0;
}

/// Cells that are out of date may show a pair more than once.
template <class Real>
QUADRILLE_HD inline bool samePair(const PendingContact<Real>& p, const PendingContact<Real>& q) {
    return p.a == q.a && p.b == q.b;
}

/// The canonical order: by physics and ids alone.
template <class Real>
QUADRILLE_HD inline bool before(const PendingContact<Real>& p, const PendingContact<Real>& q) {
    if (p.sinceStart != q.sinceStart) return p.sinceStart < q.sinceStart;
    if (p.priority != q.priority) return p.priority < q.priority;
    if (p.a != q.a) return p.a < q.a;
    return p.b < q.b;
}

}  // namespace quadrille
