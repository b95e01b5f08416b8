#pragma once

#include <cstdint>

#include "collision/rules/bodies.hpp"
#include "collision/rules/pair_contact.hpp"
#include "collision/rules/pair_geometry.hpp"

/// What a contact of the law `baseline` does to its bodies, over plain pointers, so that every
/// resolver on host and device shares it.

namespace quadrille {

/// The bodies as contacts find them, and the velocities that they will have when all are resolved.
template <class Real>
struct BaselineBodies {
    Bodies<Real> now;
    Real *futureX, *futureY;  ///< of bodies that were hit
};

/// What a contact did, along its one axis.
template <class Real>
struct BaselineOutcome {
    Penetration<Real> penetration;
    Real impulse;   ///< that the first body's change of velocity amounts to, kg px/s
    Real approach;  ///< px/s; negative if they parted: the law does not ask
};

/// The velocity along one axis that a contact gives to body `self`: of several, only the last one
/// counts.
template <class Real>
QUADRILLE_HD inline void reflectBaseline(const BaselineBodies<Real>& bodies, std::uint32_t self,
                                         Real otherX, Real otherY, Real share, std::uint8_t axis,
                                         Real restitution) {
    const auto& m = bodies.now.moving;
    Real vx = m.vx[self];
    Real vy = m.vy[self];
    if (axis == axisX) {
        vx = baselineVelocity(vx, otherX, share, restitution);
    } else {
        vy = baselineVelocity(vy, otherY, share, restitution);
    }
    bodies.futureX[self] = vx;
    bodies.futureY[self] = vy;
}

/// A moving body that overlaps another one: pushes out what can move, and sets its future velocity.
template <class Real>
QUADRILLE_HD inline BaselineOutcome<Real> resolveBaseline(const BaselineBodies<Real>& bodies,
                                                          std::uint32_t a, BodyRef other,
                                                          Real restitution) {
    const auto& m = bodies.now.moving;
    const std::uint32_t b = other.row();
    const Box<Real> boxA = movingBox(bodies.now, a);
    const Box<Real> boxB = boxOf(bodies.now, other);
    const auto p =
        leastPenetration(boxB.x - boxA.x, boxB.y - boxA.y, boxA.halfWidth + boxB.halfWidth,
                         boxA.halfHeight + boxB.halfHeight);
    Real* const position = p.axis == axisX ? m.x : m.y;
    const Real* const velocity = p.axis == axisX ? m.vx : m.vy;
    const Real before = velocity[a];
    Real approach = before * p.sense;
    if (other.isStatic()) {
        position[a] -= p.sense * p.depth;
        reflectBaseline(bodies, a, Real(0), Real(0), Real(1), p.axis, restitution);
    } else {
        approach = (before - velocity[b]) * p.sense;
        const Real total = m.mass[a] + m.mass[b];
        const Real shareA = m.mass[b] / total;
        const Real shareB = m.mass[a] / total;
        position[a] -= p.sense * (p.depth * shareA);
        position[b] += p.sense * (p.depth * shareB);
        reflectBaseline(bodies, a, m.vx[b], m.vy[b], shareA, p.axis, restitution);
        reflectBaseline(bodies, b, m.vx[a], m.vy[a], shareB, p.axis, restitution);
    }
    const Real after = (p.axis == axisX ? bodies.futureX : bodies.futureY)[a];
    return {p, m.mass[a] * magnitude(after - before), approach};
}

}  // namespace quadrille
