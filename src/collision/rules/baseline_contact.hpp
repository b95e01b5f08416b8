#pragma once

#include <cstdint>

#include <quadrille/detail/host_device.hpp>

#include "collision/rules/contact_law.hpp"
#include "collision/rules/impulse_contact.hpp"

/// What a contact of the law `baseline` does to its bodies, over plain pointers, so that every
/// resolver on host and device shares it.

namespace quadrille {

/// The bodies as contacts find them, and the velocities that they will have when all are resolved.
template <class Real>
struct BaselineBodies {
    Bodies<Real> now;
    Real *futureX, *futureY;  ///< of bodies that were hit
};

template <class Real>
QUADRILLE_HD inline bool movingOverlap(const Bodies<Real>& bodies, std::uint32_t a,
                                       std::uint32_t b) {
    const auto& m = bodies.moving;
    return overlaps(m.x[b] - m.x[a], m.y[b] - m.y[a], m.halfWidth[a] + m.halfWidth[b],
                    m.halfHeight[a] + m.halfHeight[b]);
}

template <class Real>
QUADRILLE_HD inline bool staticOverlap(const Bodies<Real>& bodies, std::uint32_t a,
                                       std::uint32_t k) {
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    return overlaps(f.x[k] - m.x[a], f.y[k] - m.y[a], m.halfWidth[a] + f.halfWidth[k],
                    m.halfHeight[a] + f.halfHeight[k]);
}

/// The velocity that a contact gives to body `self`: of several, only the last one counts.
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

/// Two moving bodies that overlap: pushes both out and sets both future velocities.
template <class Real>
QUADRILLE_HD inline Penetration<Real> resolveBaseline(const BaselineBodies<Real>& bodies,
                                                      std::uint32_t a, std::uint32_t b,
                                                      Real restitution) {
    const auto& m = bodies.now.moving;
    const auto p =
        leastPenetration(m.x[b] - m.x[a], m.y[b] - m.y[a], m.halfWidth[a] + m.halfWidth[b],
                         m.halfHeight[a] + m.halfHeight[b]);
    const Real total = m.mass[a] + m.mass[b];
    const Real shareA = m.mass[b] / total;
    const Real shareB = m.mass[a] / total;
    Real* const position = p.axis == axisX ? m.x : m.y;
    position[a] -= p.sense * (p.depth * shareA);
    position[b] += p.sense * (p.depth * shareB);
    reflectBaseline(bodies, a, m.vx[b], m.vy[b], shareA, p.axis, restitution);
    reflectBaseline(bodies, b, m.vx[a], m.vy[a], shareB, p.axis, restitution);
    return p;
}

/// A moving body that overlaps the static one in row k.
template <class Real>
QUADRILLE_HD inline Penetration<Real> resolveBaselineStatic(const BaselineBodies<Real>& bodies,
                                                            std::uint32_t a, std::uint32_t k,
                                                            Real restitution) {
    const auto& m = bodies.now.moving;
    const auto& f = bodies.now.fixed;
    const auto p =
        leastPenetration(f.x[k] - m.x[a], f.y[k] - m.y[a], m.halfWidth[a] + f.halfWidth[k],
                         m.halfHeight[a] + f.halfHeight[k]);
    (p.axis == axisX ? m.x : m.y)[a] -= p.sense * p.depth;
    reflectBaseline(bodies, a, Real(0), Real(0), Real(1), p.axis, restitution);
    return p;
}

}  // namespace quadrille
