#pragma once

#include <cstdint>

#include <quadrille/detail/host_device.hpp>

#include "collision/rules/bodies.hpp"
#include "collision/rules/contact_order.hpp"
#include "collision/rules/pair_contact.hpp"
#include "collision/rules/pair_geometry.hpp"
#include "collision/rules/step_parameters.hpp"

/// What a contact of the law `impulse` is and what it does to its bodies, over plain pointers, so
/// that every resolver on host and device shares it.

namespace quadrille {

template <class Real>
QUADRILLE_HD inline PendingContact<Real> pendingContact(const Impact<Real>& impact, Real dt,
                                                        std::uint32_t priority, std::uint32_t a,
                                                        BodyRef b) {
    return {impact.overlapBefore ? Real(0) : dt - impact.since,
            priority,
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
    return pendingContact(impact, dt, pairPriority(m.entity[a], m.entity[b]), a,
                          BodyRef::moving(b));
}

/// What a body touches at the same time comes in an order that lets it slide over level boxes: what
/// it is deepest in first, then what it meets with a side that it faced already, and last what it
/// comes to round a corner, which the others may have kept it from.
template <class Real>
QUADRILLE_HD inline std::uint32_t staticPriority(std::uint32_t tie, const Impact<Real>& impact,
                                                 bool roundCorner, Real depth, Real reach) {
    constexpr std::uint32_t half = 0x8000'0000u;
    if (roundCorner) return tie | half;
    if (!impact.overlapBefore) return tie >> 2 | half >> 1;
    const Real shallow = reach / (reach + depth);  // from a half to one
    return static_cast<std::uint32_t>(shallow * Real(half >> 1));
}

/// The contact of the moving body in row a with the static one in row k. An impact as good as at
/// the start of the step counts as one at the start.
template <class Real>
QUADRILLE_HD inline PendingContact<Real> staticContact(const Bodies<Real>& bodies, std::uint32_t a,
                                                       std::uint32_t k, Real dt) {
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    const Real reachX = m.halfWidth[a] + f.halfWidth[k];
    const Real reachY = m.halfHeight[a] + f.halfHeight[k];
    const Real dx = f.x[k] - m.x[a];
    const Real dy = f.y[k] - m.y[a];
    const Real slackX = roundingOf(f.x[k], reachX);
    const Real slackY = roundingOf(f.y[k], reachY);
    Impact<Real> impact = impactOf(dx, dy, -m.vx[a], -m.vy[a], reachX, reachY, dt, slackX, slackY);
    const Real gapX = magnitude(dx + m.vx[a] * dt) - reachX;
    const Real gapY = magnitude(dy + m.vy[a] * dt) - reachY;
    const bool alongX = impact.axes == axisX;
    if (!impact.overlapBefore && (alongX ? gapX <= slackX : gapY <= slackY)) impact.since = dt;
    const std::uint32_t priority = staticPriority(
        pairPriority(m.entity[a], f.entity[k]), impact, gapX >= -slackX && gapY >= -slackY,
        alongX ? reachX - magnitude(dx) : reachY - magnitude(dy), alongX ? reachX : reachY);
    return pendingContact(impact, dt, priority, a, BodyRef::fixed(k));
}

/// What a contact did along both axes.
template <class Real>
struct ContactOutcome {
    AxisOutcome<Real> x, y;

    QUADRILLE_HD bool collided() const { return x.collided || y.collided; }
};

/// One axis of a contact, for whichever bodies it has.
template <class Real>
struct ContactAxis {
    Real *position, *velocity;  ///< of the moving bodies, by row
    Real sense, reach;          ///< reach: the distance of the centres when they touch, px
    Real fixedPosition;         ///< of the static body, px
    Real gravity;               ///< px/s^2
};

/// One axis of a contact between two moving bodies.
template <class Real>
QUADRILLE_HD QUADRILLE_INLINE AxisOutcome<Real> resolveMoving(const Bodies<Real>& bodies,
                                                              const PendingContact<Real>& c,
                                                              const ContactAxis<Real>& axis,
                                                              const StepParameters<Real>& step) {
    const auto& mass = bodies.moving.mass;
    const std::uint32_t other = c.b.row();
    AxisState<Real> a{axis.position[c.a], axis.velocity[c.a]};
    AxisState<Real> b{axis.position[other], axis.velocity[other]};
    const Real since = c.overlapBefore ? Real(0) : step.dt - c.sinceStart;
    const auto outcome = collide(a, b, mass[c.a], mass[other], step.restitution, axis.reach,
                                 axis.sense, since, c.overlapBefore != 0);
    axis.position[c.a] = a.position;
    axis.velocity[c.a] = a.velocity;
    axis.position[other] = b.position;
    axis.velocity[other] = b.velocity;
    return outcome;
}

/// One axis of a contact between a moving body and a static one.
template <class Real>
QUADRILLE_HD QUADRILLE_INLINE AxisOutcome<Real> resolveStatic(const Bodies<Real>& bodies,
                                                              const PendingContact<Real>& c,
                                                              const ContactAxis<Real>& axis,
                                                              const StepParameters<Real>& step) {
    AxisState<Real> a{axis.position[c.a], axis.velocity[c.a]};
    const Real since = c.overlapBefore ? Real(0) : step.dt - c.sinceStart;
    // An old overlap counts as an impact at the start of the step, as its sinceStart says.
    const Real gained = gainedSinceImpact(axis.gravity, step.dt - c.sinceStart, step.dt);
    const auto outcome =
        collideStatic(a, bodies.moving.mass[c.a], axis.fixedPosition, step.restitution, axis.reach,
                      axis.sense, since, c.overlapBefore != 0, gained);
    axis.position[c.a] = a.position;
    axis.velocity[c.a] = a.velocity;
    return outcome;
}

/// Whether a pair still overlaps when the turn of a contact along an axis comes: along the other
/// axis, where what merely touches slides past (static bodies are level within rounding), and along
/// its own.
template <class Real>
QUADRILLE_HD inline bool stillMeets(Real distance, Real reach, Real sense, Real otherDistance,
                                    Real otherReach, Real otherSlack) {
    return (otherReach - magnitude(otherDistance) > otherSlack) & (sense * distance <= reach);
}

/// One axis of a contact that has one or both.
template <class Real>
QUADRILLE_HD QUADRILLE_INLINE AxisOutcome<Real> resolveAxis(const Bodies<Real>& bodies,
                                                            const PendingContact<Real>& c,
                                                            const ContactAxis<Real>& axis,
                                                            const StepParameters<Real>& step) {
    return c.b.isStatic() ? resolveStatic(bodies, c, axis, step)
                          : resolveMoving(bodies, c, axis, step);
}

/// Carries the contact out: changes position and velocity of its moving bodies, if contacts before
/// it have not parted them. The contacts of a body must be carried out in canonical order.
template <class Real>
QUADRILLE_HD QUADRILLE_INLINE ContactOutcome<Real> resolveContact(
    const Bodies<Real>& bodies, const PendingContact<Real>& c, const StepParameters<Real>& step) {
    const auto& m = bodies.moving;
    const bool withStatic = c.b.isStatic();
    const Box<Real> a = movingBox(bodies, c.a);
    const Box<Real> b = boxOf(bodies, c.b);
    const Real dx = b.x - a.x;
    const Real dy = b.y - a.y;
    const Real reachX = a.halfWidth + b.halfWidth;
    const Real reachY = a.halfHeight + b.halfHeight;
    const Real slackX = withStatic ? roundingOf(b.x, reachX) : Real(0);
    const Real slackY = withStatic ? roundingOf(b.y, reachY) : Real(0);
    const ContactAxis<Real> x{m.x, m.vx, Real(c.senseX), reachX, b.x, step.gravityX};
    const ContactAxis<Real> y{m.y, m.vy, Real(c.senseY), reachY, b.y, step.gravityY};
    const bool meetsX = stillMeets(dx, reachX, x.sense, dy, reachY, slackY);
    const bool meetsY = stillMeets(dy, reachY, y.sense, dx, reachX, slackX);
    ContactOutcome<Real> outcome{};
    if (c.axes == (axisX | axisY)) {
        if (meetsX) outcome.x = resolveAxis(bodies, c, x, step);
        if (meetsY) outcome.y = resolveAxis(bodies, c, y, step);
        return outcome;
    }
    // Which axis it is, is a coin toss that a branch would lose.
    const bool alongX = c.axes == axisX;
    if (alongX ? !meetsX : !meetsY) return outcome;
    const ContactAxis<Real> axis{alongX ? x.position : y.position,
                                 alongX ? x.velocity : y.velocity,
                                 alongX ? x.sense : y.sense,
                                 alongX ? x.reach : y.reach,
                                 alongX ? x.fixedPosition : y.fixedPosition,
                                 alongX ? x.gravity : y.gravity};
    const AxisOutcome<Real> along = resolveAxis(bodies, c, axis, step);
    outcome.x = alongX ? along : AxisOutcome<Real>{};
    outcome.y = alongX ? AxisOutcome<Real>{} : along;
    return outcome;
}

}  // namespace quadrille
