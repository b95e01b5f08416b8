#pragma once

#include <cstdint>

#include <quadrille/detail/host_device.hpp>

#include "collision/rules/bodies.hpp"
#include "collision/rules/canonical_order.hpp"
#include "collision/rules/contact_law.hpp"
#include "collision/rules/step_parameters.hpp"

/// What a contact of the law `impulse` is and what it does to its bodies, over plain pointers, so
/// that every resolver on host and device shares it.

namespace quadrille {

template <class Real>
QUADRILLE_HD inline PendingContact<Real> pendingContact(const Impact<Real>& impact, Real dt,
                                                        std::uint32_t entityA,
                                                        std::uint32_t entityB, std::uint32_t a,
                                                        std::uint32_t b) {
    return {impact.overlapBefore ? Real(0) : dt - impact.since,
            pairPriority(entityA, entityB),
            a,
            b,
            impact.axes,
            impact.overlapBefore,
            impact.senseX,
            impact.senseY};
}

/// The contact of the moving bodies in rows a < b, which overlap at the end of the step.
template <class Real>
QUADRILLE_HD inline PendingContact<Real> movingContact(const Bodies<Real>& bodies, std::uint32_t a,
                                                       std::uint32_t b, Real dt) {
    const auto& m = bodies.moving;
    const Impact<Real> impact =
        impactOf(m.x[b] - m.x[a], m.y[b] - m.y[a], m.vx[b] - m.vx[a], m.vy[b] - m.vy[a],
                 m.halfWidth[a] + m.halfWidth[b], m.halfHeight[a] + m.halfHeight[b], dt);
    return pendingContact(impact, dt, m.entity[a], m.entity[b], a, b);
}

/// The contact of the moving body in row a with the static one in row k.
template <class Real>
QUADRILLE_HD inline PendingContact<Real> staticContact(const Bodies<Real>& bodies, std::uint32_t a,
                                                       std::uint32_t k, Real dt) {
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    const Impact<Real> impact =
        impactOf(f.x[k] - m.x[a], f.y[k] - m.y[a], -m.vx[a], -m.vy[a],
                 m.halfWidth[a] + f.halfWidth[k], m.halfHeight[a] + f.halfHeight[k], dt);
    return pendingContact(impact, dt, m.entity[a], f.entity[k], a,
                          k | PendingContact<Real>::staticBit);
}

/// One axis of a contact between two moving bodies.
template <class Real>
QUADRILLE_HD inline bool resolveAxis(Real* position, Real* velocity, const SharedColumn<Real>& half,
                                     const SharedColumn<Real>& mass, const PendingContact<Real>& c,
                                     Real sense, const StepParameters<Real>& step) {
    AxisState<Real> a{position[c.a], velocity[c.a]};
    AxisState<Real> b{position[c.b], velocity[c.b]};
    const Real since = c.overlapBefore ? Real(0) : step.dt - c.sinceStart;
    const bool collided = collide(a, b, mass[c.a], mass[c.b], step.restitution,
                                  half[c.a] + half[c.b], sense, since, c.overlapBefore != 0);
    position[c.a] = a.position;
    velocity[c.a] = a.velocity;
    position[c.b] = b.position;
    velocity[c.b] = b.velocity;
    return collided;
}

/// One axis of a contact between a moving body and a static one.
template <class Real>
QUADRILLE_HD inline bool resolveStaticAxis(Real* position, Real* velocity,
                                           const SharedColumn<Real>& half, Real fixedPosition,
                                           Real fixedHalf, const PendingContact<Real>& c,
                                           Real sense, Real gravity,
                                           const StepParameters<Real>& step) {
    AxisState<Real> a{position[c.a], velocity[c.a]};
    const Real since = c.overlapBefore ? Real(0) : step.dt - c.sinceStart;
    // An old overlap counts as an impact at the start of the step, as its sinceStart says.
    const Real gained = gainedSinceImpact(gravity, step.dt - c.sinceStart, step.dt);
    const bool collided = collideStatic(a, fixedPosition, step.restitution, half[c.a] + fixedHalf,
                                        sense, since, c.overlapBefore != 0, gained);
    position[c.a] = a.position;
    velocity[c.a] = a.velocity;
    return collided;
}

/// Carries the contact out: changes position and velocity of its moving bodies. Returns whether an
/// impulse was exchanged. The contacts of a body must be carried out in canonical order.
template <class Real>
QUADRILLE_HD inline bool resolveContact(const Bodies<Real>& bodies, const PendingContact<Real>& c,
                                        const StepParameters<Real>& step) {
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    bool collided = false;
    if ((c.b & PendingContact<Real>::staticBit) == 0) {
        if ((c.axes & axisX) != 0) {
            collided |= resolveAxis(m.x, m.vx, m.halfWidth, m.mass, c, Real(c.senseX), step);
        }
        if ((c.axes & axisY) != 0) {
            collided |= resolveAxis(m.y, m.vy, m.halfHeight, m.mass, c, Real(c.senseY), step);
        }
    } else {
        const std::uint32_t k = c.b & ~PendingContact<Real>::staticBit;
        if ((c.axes & axisX) != 0) {
            collided |= resolveStaticAxis(m.x, m.vx, m.halfWidth, f.x[k], f.halfWidth[k], c,
                                          Real(c.senseX), step.gravityX, step);
        }
        if ((c.axes & axisY) != 0) {
            collided |= resolveStaticAxis(m.y, m.vy, m.halfHeight, f.y[k], f.halfHeight[k], c,
                                          Real(c.senseY), step.gravityY, step);
        }
    }
    return collided;
}

}  // namespace quadrille
