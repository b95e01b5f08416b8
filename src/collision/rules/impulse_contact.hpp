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
                                                        BodyRef b) {
    return {impact.overlapBefore ? Real(0) : dt - impact.since,
            pairPriority(entityA, entityB),
            a,
            b,
            impact.axes,
            impact.overlapBefore,
            impact.senseX,
            impact.senseY};
}

/// The contact of the moving bodies in two rows, which overlap at the end of the step.
template <class Real>
QUADRILLE_HD inline PendingContact<Real> movingContact(const Bodies<Real>& bodies,
                                                       std::uint32_t row, std::uint32_t other,
                                                       Real dt) {
    const auto& m = bodies.moving;
    const bool inOrder = m.created[row] < m.created[other];
    const std::uint32_t a = inOrder ? row : other;
    const std::uint32_t b = inOrder ? other : row;
    const Impact<Real> impact =
        impactOf(m.x[b] - m.x[a], m.y[b] - m.y[a], m.vx[b] - m.vx[a], m.vy[b] - m.vy[a],
                 m.halfWidth[a] + m.halfWidth[b], m.halfHeight[a] + m.halfHeight[b], dt);
    return pendingContact(impact, dt, m.entity[a], m.entity[b], a, BodyRef::moving(b));
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
    return pendingContact(impact, dt, m.entity[a], f.entity[k], a, BodyRef::fixed(k));
}

/// What a contact did along both axes.
template <class Real>
struct ContactOutcome {
    AxisOutcome<Real> x, y;

    QUADRILLE_HD bool collided() const { return x.collided || y.collided; }
};

/// One axis of a contact between two moving bodies.
template <class Real>
QUADRILLE_HD QUADRILLE_INLINE AxisOutcome<Real> resolveAxis(
    Real* position, Real* velocity, const SharedColumn<Real>& half, const SharedColumn<Real>& mass,
    const PendingContact<Real>& c, Real sense, const StepParameters<Real>& step) {
    const std::uint32_t other = c.b.row();
    AxisState<Real> a{position[c.a], velocity[c.a]};
    AxisState<Real> b{position[other], velocity[other]};
    const Real since = c.overlapBefore ? Real(0) : step.dt - c.sinceStart;
    const auto outcome = collide(a, b, mass[c.a], mass[other], step.restitution,
                                 half[c.a] + half[other], sense, since, c.overlapBefore != 0);
    position[c.a] = a.position;
    velocity[c.a] = a.velocity;
    position[other] = b.position;
    velocity[other] = b.velocity;
    return outcome;
}

/// One axis of a contact between a moving body and a static one.
template <class Real>
QUADRILLE_HD QUADRILLE_INLINE AxisOutcome<Real> resolveStaticAxis(
    Real* position, Real* velocity, const SharedColumn<Real>& half, const SharedColumn<Real>& mass,
    Real fixedPosition, Real fixedHalf, const PendingContact<Real>& c, Real sense, Real gravity,
    const StepParameters<Real>& step) {
    AxisState<Real> a{position[c.a], velocity[c.a]};
    const Real since = c.overlapBefore ? Real(0) : step.dt - c.sinceStart;
    // An old overlap counts as an impact at the start of the step, as its sinceStart says.
    const Real gained = gainedSinceImpact(gravity, step.dt - c.sinceStart, step.dt);
    const auto outcome =
        collideStatic(a, mass[c.a], fixedPosition, step.restitution, half[c.a] + fixedHalf, sense,
                      since, c.overlapBefore != 0, gained);
    position[c.a] = a.position;
    velocity[c.a] = a.velocity;
    return outcome;
}

/// Carries the contact out: changes position and velocity of its moving bodies. The contacts of a
/// body must be carried out in canonical order.
template <class Real>
QUADRILLE_HD QUADRILLE_INLINE ContactOutcome<Real> resolveContact(
    const Bodies<Real>& bodies, const PendingContact<Real>& c, const StepParameters<Real>& step) {
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    ContactOutcome<Real> outcome{};
    const std::uint32_t k = c.b.row();
    const bool withStatic = c.b.isStatic();
    if ((c.axes & axisX) != 0) {
        outcome.x = withStatic
                        ? resolveStaticAxis(m.x, m.vx, m.halfWidth, m.mass, f.x[k], f.halfWidth[k],
                                            c, Real(c.senseX), step.gravityX, step)
                        : resolveAxis(m.x, m.vx, m.halfWidth, m.mass, c, Real(c.senseX), step);
    }
    if ((c.axes & axisY) != 0) {
        outcome.y = withStatic
                        ? resolveStaticAxis(m.y, m.vy, m.halfHeight, m.mass, f.y[k],
                                            f.halfHeight[k], c, Real(c.senseY), step.gravityY, step)
                        : resolveAxis(m.y, m.vy, m.halfHeight, m.mass, c, Real(c.senseY), step);
    }
    return outcome;
}

}  // namespace quadrille
