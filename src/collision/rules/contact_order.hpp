#pragma once

#include <cstdint>

#include <quadrille/body_ref.hpp>
#include <quadrille/detail/host_device.hpp>

#include "collision/rules/bodies.hpp"
#include "collision/rules/mix64.hpp"

namespace quadrille {

/// Breaks ties between contacts of the same time. A hash and not the ids themselves: ids that rise
/// along a row of touching bodies would chain all their contacts one behind the other, which leaves
/// nothing to do in parallel (Blelloch, Fineman, Gibbons & Shun 2012).
QUADRILLE_HD inline std::uint32_t pairPriority(std::uint32_t entityA, std::uint32_t entityB) {
    return static_cast<std::uint32_t>(mix64((std::uint64_t(entityA) << 32) | entityB) >> 32);
}

/// A contact to be resolved by the law `impulse`.
template <class Real>
struct PendingContact {
    Real sinceStart;         ///< s from the start of the step to the impact; the first key
    std::uint32_t priority;  ///< the second key
    std::uint32_t a;         ///< row of the moving body that was created first; the third key
    BodyRef b;               ///< the other body; the last key
    std::uint8_t axes;
    std::uint8_t overlapBefore;
    std::int8_t senseX, senseY;
};

/// Cells that are out of date may show a pair more than once.
template <class Real>
QUADRILLE_HD inline bool samePair(const PendingContact<Real>& p, const PendingContact<Real>& q) {
    return p.a == q.a && p.b == q.b;
}

/// The canonical order: by time, a hash of the entities, and the order of creation.
struct CanonicalOrder {
    CreationNumbers moving, fixed;

    /// A number that orders bodies as they were created, static ones after moving ones.
    QUADRILLE_HD std::uint32_t rank(BodyRef body) const {
        return body.isStatic() ? fixed[body.row()] | BodyRef::staticBit : moving[body.row()];
    }

    /// Whether p comes before q.
    template <class Real>
    QUADRILLE_HD bool operator()(const PendingContact<Real>& p,
                                 const PendingContact<Real>& q) const {
        if (p.sinceStart != q.sinceStart) return p.sinceStart < q.sinceStart;
        if (p.priority != q.priority) return p.priority < q.priority;
        if (p.a != q.a) return moving[p.a] < moving[q.a];
        return rank(p.b) < rank(q.b);
    }
};

template <class Real>
QUADRILLE_HD inline CanonicalOrder canonicalOrder(const Bodies<Real>& bodies) {
    return {bodies.moving.created, bodies.fixed.created};
}

}  // namespace quadrille
