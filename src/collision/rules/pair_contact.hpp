#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include <quadrille/detail/host_device.hpp>

/// The geometry of a pair of boxes and what a contact does to them, for host and device alike.
/// Only + - * / and comparisons, so that every IEEE machine without contraction gives the same
/// bits.

namespace quadrille {

template <class Real>
QUADRILLE_HD inline Real magnitude(Real value) {
    return std::abs(value);
}

/// Open boxes intersect: level edges do not touch. `reach` is the sum of the half extents.
template <class Real>
QUADRILLE_HD inline bool overlaps(Real dx, Real dy, Real reachX, Real reachY) {
    return (magnitude(dx) < reachX) & (magnitude(dy) < reachY);
}

template <class Real>
inline constexpr Real eightUlps = 8 * std::numeric_limits<Real>::epsilon();

/// By how much rounding may put a box deeper into another than it is, px: `position` is a
/// coordinate of one of them, `reach` the sum of their half extents along it. Boxes that are level
/// where they were made still touch within it, whatever their sizes and places.
template <class Real>
QUADRILLE_HD inline Real roundingOf(Real position, Real reach) {
    return eightUlps<Real> * (magnitude(position) + reach);
}

inline constexpr std::uint8_t axisX = 1;
inline constexpr std::uint8_t axisY = 2;

/// When and how the boxes of a pair met, seen from the end of a step in which they overlap.
template <class Real>
struct Impact {
    Real since;          ///< time from impact to the end of the step, s; 0 for old overlaps
    std::uint8_t axes;   ///< axisX, axisY or both at a corner
    bool overlapBefore;  ///< the boxes overlapped when the step began
    std::int8_t senseX;  ///< +1 if b lies to the right of a
    std::int8_t senseY;  ///< +1 if b lies above a
};

/// Impact of boxes a and b that overlap at the end of a step. (dx, dy) = centre of b - centre of a
/// at the end of the step, (ux, uy) = velocity of b - velocity of a during it.
///
/// Both gaps must be closed for a contact, so the axis whose gap closed last is the contact's axis
/// (separating axis theorem for moving boxes). Pairs that overlapped before take the axis of least
/// penetration, and x where both are equal. What was no deeper than the slack of an axis touched.
template <class Real>
QUADRILLE_HD inline Impact<Real> impactOf(Real dx, Real dy, Real ux, Real uy, Real reachX,
                                          Real reachY, Real dt, Real slackX = 0, Real slackY = 0) {
    const Real startX = dx - ux * dt;
    const Real startY = dy - uy * dt;
    const bool openX = magnitude(startX) >= reachX - slackX;
    const bool openY = magnitude(startY) >= reachY - slackY;
    if (!openX && !openY) {
        const bool alongX = reachX - magnitude(dx) <= reachY - magnitude(dy);
        // Equal centres have no direction: the body that was created first goes to the low side.
        return {Real(0), alongX ? axisX : axisY, true, std::int8_t(dx >= 0 ? 1 : -1),
                std::int8_t(dy >= 0 ? 1 : -1)};
    }
    // The side is that of the start: a fast body may have passed the other's centre since.
    const std::int8_t senseX = (openX ? startX : dx) >= 0 ? 1 : -1;
    const std::int8_t senseY = (openY ? startY : dy) >= 0 ? 1 : -1;
    const Real sinceX = openX ? (reachX - Real(senseX) * dx) / magnitude(ux) : Real(0);
    const Real sinceY = openY ? (reachY - Real(senseY) * dy) / magnitude(uy) : Real(0);
    std::uint8_t axes;
    if (openX && openY) {
        axes = sinceX < sinceY ? axisX : sinceY < sinceX ? axisY : std::uint8_t(axisX | axisY);
    } else {
        axes = openX ? axisX : axisY;
    }
    const Real since = (axes & axisX) != 0 ? sinceX : sinceY;
    return {since < dt ? since : dt, axes, false, senseX, senseY};
}

/// What a contact did along one axis.
template <class Real>
struct AxisOutcome {
    bool collided;  ///< the bodies approached and exchanged an impulse
    Real impulse;   ///< its size, kg px/s
    Real approach;  ///< speed of approach before, px/s; negative if they parted
};

/// What both bodies of a pair have along one axis.
template <class Real>
struct AxisState {
    Real position, velocity;
};

/// Exchanges the impulse of a collision along one axis. Equal masses that collide elastically swap
/// their velocities, so that the set of speeds keeps its bits.
template <class Real>
QUADRILLE_HD QUADRILLE_INLINE void exchangeImpulse(Real& va, Real& vb, Real massA, Real massB,
                                                   Real restitution) {
    if (massA == massB && restitution == 1) {
        const Real kept = va;
        va = vb;
        vb = kept;
        return;
    }
    const Real change = (1 + restitution) * (vb - va);
    const Real total = massA + massB;
    va += massB / total * change;
    vb -= massA / total * change;
}

/// The law `impulse` for two moving bodies along one axis. If they approach, they exchange an
/// impulse, and each is moved by its change of velocity times the time since impact, so that a
/// collision of two ends where the exact one does. Overlap from before the step is pushed out in
/// inverse proportion to mass.
template <class Real>
QUADRILLE_HD QUADRILLE_INLINE AxisOutcome<Real> collide(AxisState<Real>& a, AxisState<Real>& b,
                                                        Real massA, Real massB, Real restitution,
                                                        Real reach, Real sense, Real since,
                                                        bool overlapBefore) {
    const Real approach = -((b.velocity - a.velocity) * sense);
    const bool approaching = approach > 0;
    Real impulse = 0;
    if (approaching) {
        const Real oldA = a.velocity;
        const Real oldB = b.velocity;
        exchangeImpulse(a.velocity, b.velocity, massA, massB, restitution);
        a.position += (a.velocity - oldA) * since;
        b.position += (b.velocity - oldB) * since;
        impulse = massA * magnitude(a.velocity - oldA);
    }
    if (overlapBefore) {
        const Real depth = reach - sense * (b.position - a.position);
        if (depth > 0) {
            const Real total = massA + massB;
            a.position -= sense * (depth * (massB / total));
            b.position += sense * (depth * (massA / total));
        }
    }
    return {approaching, impulse, approach};
}

/// Change of velocity between the impact and the velocity of the step. The rule v += g dt, x += v
/// dt gives the velocity of the middle of the step, and conserves v^2 / 2 - g x + g dt v / 2;
/// reflecting about this change keeps that sum in a bounce.
template <class Real>
QUADRILLE_HD inline Real gainedSinceImpact(Real gravity, Real since, Real dt) {
    return gravity * (since - dt / 2);
}

/// The law `impulse` for a moving body against a static one. The velocity of the impact is what is
/// reflected: that of the step less what gravity has `gained` since. A body that would still go in
/// afterwards rests on the surface.
template <class Real>
QUADRILLE_HD QUADRILLE_INLINE AxisOutcome<Real> collideStatic(AxisState<Real>& a, Real mass,
                                                              Real fixedPosition, Real restitution,
                                                              Real reach, Real sense, Real since,
                                                              bool overlapBefore, Real gained) {
    const Real approach = a.velocity * sense;
    const bool approaching = approach > 0;
    Real impulse = 0;
    if (approaching) {
        const Real old = a.velocity;
        a.velocity = gained - restitution * (old - gained);
        if (a.velocity * sense > 0) a.velocity = 0;
        a.position += (a.velocity - old) * since;
        impulse = mass * magnitude(a.velocity - old);
    }
    if (overlapBefore) {
        const Real depth = reach - sense * (fixedPosition - a.position);
        if (depth > 0) a.position -= sense * depth;
    }
    return {approaching, impulse, approach};
}

/// Axis of least penetration and penetration of two overlapping boxes, for the law `baseline`.
template <class Real>
struct Penetration {
    std::uint8_t axis;
    Real depth;
    Real sense;  ///< +1 if b lies on the high side of a
};

template <class Real>
QUADRILLE_HD inline Penetration<Real> leastPenetration(Real dx, Real dy, Real reachX, Real reachY) {
    const Real depthX = reachX - magnitude(dx);
    const Real depthY = reachY - magnitude(dy);
    if (depthX <= depthY) return {axisX, depthX, Real(dx >= 0 ? 1 : -1)};
    return {axisY, depthY, Real(dy >= 0 ? 1 : -1)};
}

/// The law `baseline`: velocity of a body after it met another, v - n ((v - v_other) . n) (1 + e)
/// m_other / (m_self + m_other), along the one axis n (the report's law; its e is 1). `share` is
/// the mass ratio, 1 against a static body.
template <class Real>
QUADRILLE_HD inline Real baselineVelocity(Real self, Real other, Real share, Real restitution) {
    return self - (self - other) * ((1 + restitution) * share);
}

}  // namespace quadrille
