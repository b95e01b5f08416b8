#pragma once

#include <cmath>
#include <cstdint>

#include <quadrille/body_ref.hpp>
#include <quadrille/detail/host_device.hpp>

#include "collision/rules/event_order.hpp"
#include "collision/rules/pair_contact.hpp"
#include "collision/rules/paths.hpp"
#include "collision/rules/rest_rules.hpp"
#include "collision/rules/trajectory.hpp"

/// What an event does to its bodies, for host and device alike.
///
/// Equal masses that collide elastically exchange paths, shifted by the distance of their centres:
/// no rounding at all where sizes and anchors lie on a lattice of doubles.
///
/// Pairs that overlap all the same, from the start or by rounding, count as touching on their axis
/// of least penetration and collide only if they approach (Bannerman et al., arXiv:1211.6718). Deep
/// inside each other and without loss, they do so once at any instant.
///
/// What would otherwise have no end, ends so. Bodies come to rest on what holds them
/// (rest_rules.hpp). Where restitution is below 1, pairs that would part slower than `restSpeed` go
/// on with their common velocity. A body that
/// rests is held by its support: with restitution below 1, what falls on it rebounds as from the
/// support itself (Newton's law for simultaneous impacts; Moreau 1988), so that a pile does not
/// pass each impact down and up again without end. And a body that collides again and again at one
/// instant, because it exactly fits between others or is jammed among them, loses what it collides
/// with: restitution is 0 there, and moving bodies deep inside each other let each other pass.

namespace quadrille {

/// With restitution below 1, bodies that would part slower than this do not part, and those that
/// approach slower than `creepSpeed` do not collide, px/s.
inline constexpr double restSpeed = 1e-6;
inline constexpr double creepSpeed = 1e-9;

/// A body that collides with static ones more often than this at one instant, and with no other
/// body in between, exactly fits between them.
inline constexpr std::uint32_t mostHeld = 8;

/// Approaches slower than this are none: rounding leaves bodies that move together so. 0 where
/// restitution is 1, px/s.
template <class Real>
QUADRILLE_HD inline double creep(double va, double vb, double restitution) {
    if (restitution == 1) return 0;
    constexpr double eps = 4 * machineEpsilon<Real>;
    const double rounded = eps * (magnitude(va) + magnitude(vb));
    return creepSpeed < rounded ? rounded : creepSpeed;
}

/// How the pair of an event that is no release stands to each other.
struct EventContact {
    std::uint8_t axes;  ///< axisX, axisY, or both at a corner
    std::int8_t senseX, senseY;
    bool deep;  ///< the pair overlaps by more than rounding
};

template <class Real, class Path>
QUADRILLE_HD inline EventContact contactOf(const ExactMotion<Real, Path>& motion,
                                           const PairEvent& event) {
    const double now = event.time;
    const auto a = motion.paths(event.a);
    const auto b = motion.paths(event.b);
    const double dx = b.along[0].position(now) - a.along[0].position(now);
    const double dy = b.along[1].position(now) - a.along[1].position(now);
    EventContact contact{event.axes, static_cast<std::int8_t>(dx >= 0 ? 1 : -1),
                         static_cast<std::int8_t>(dy >= 0 ? 1 : -1), false};
    if (event.axes == 0) {
        const double reachX = motion.reachOf(event.a, event.b, 0);
        const double reachY = motion.reachOf(event.a, event.b, 1);
        const auto least = leastPenetration(dx, dy, reachX, reachY);
        const int axis = least.axis == axisX ? 0 : 1;
        const double slack =
            motion.rounding(a.along[axis], b.along[axis], axis == 0 ? reachX : reachY, now);
        contact.axes = least.axis;
        contact.deep = least.depth > slack;
    }
    return contact;
}

/// For how long the pair of an event has been within the touching distance at most, s: at the speed
/// at which it meets.
template <class Real, class Path>
QUADRILLE_HD inline double touchingFor(const ExactMotion<Real, Path>& motion,
                                       const PairEvent& event, std::uint8_t axes) {
    const double now = event.time;
    double longest = 0;
    for (int axis = 0; axis < 2; ++axis) {
        if ((axes & axisBit(axis)) == 0) continue;
        const double speed =
            motion.path(event.b, axis).speed(now) - motion.path(event.a, axis).speed(now);
        const double room = touchTolerance * motion.reachOf(event.a, event.b, axis);
        const double since = speed == 0 ? never : room / magnitude(speed);
        longest = since > longest ? since : longest;
    }
    return longest;
}

enum class Outcome : std::uint8_t { Nothing, Touch, Collision };

/// What an event did along an axis.
struct EventOutcome {
    Outcome outcome = Outcome::Nothing;
    bool rests = false;   ///< one of the bodies has come to rest
    double impulse = 0;   ///< kg px/s, that the bodies gave each other
    double approach = 0;  ///< px/s, of each other before
};

/// Where a body stands that touches another; where it stands now if it is deep inside.
template <class Real, class Path>
QUADRILLE_HD inline double surfaceFor(const ExactMotion<Real, Path>& motion, const PairEvent& event,
                                      std::uint32_t row, BodyRef other, int axis, double sense) {
    const Path p = motion.path(row, axis);
    const Path q = motion.path(other, axis);
    const double at = p.position(event.time);
    const double reach = motion.reachOf(row, other, axis);
    const double surface = q.position(event.time) - sense * reach;
    const bool deep =
        event.axes == 0 && magnitude(at - surface) > motion.rounding(p, q, reach, event.time);
    return deep ? at : surface;
}

/// Whether the moving pair of an event meets along an axis, or has met at this instant and overlaps
/// only because times are rounded.
template <class Real, class Path>
QUADRILLE_HD inline bool meets(const ExactMotion<Real, Path>& motion, const PairEvent& event,
                               int axis, double sense) {
    if (event.axes != 0) return true;
    constexpr double eps = machineEpsilon<double>;
    const double now = event.time;
    const Path p = motion.path(event.a, axis);
    const Path q = motion.path(event.b, axis);
    const double a = p.position(now);
    const double b = q.position(now);
    const double reach = motion.reachOf(event.a, event.b, axis);
    const double speeds = magnitude(p.speed(now)) + magnitude(q.speed(now));
    const double slack =
        8 * eps * (magnitude(a) + magnitude(b) + reach) + 2 * eps * magnitude(now) * speeds;
    return magnitude((b - a) * sense - reach) <= slack;
}

// ---- elastic collisions

/// Two bodies that are free to move collide elastically along an axis. Returns the impulse, kg
/// px/s.
template <class Real, class Path>
QUADRILLE_HD inline double exchange(const ExactMotion<Real, Path>& motion, const PairEvent& event,
                                    int axis, double sense) {
    const double now = event.time;
    const Path a = motion.path(event.a, axis);
    const Path b = motion.path(event.b, axis);
    const double massA = motion.bodies.moving.mass[event.a];
    const double massB = motion.bodies.moving.mass[event.b.row()];
    const double before = a.speed(now);
    double va = before;
    double vb = b.speed(now);
    if (massA == massB && acceleration(a) == acceleration(b) && meets(motion, event, axis, sense)) {
        const std::uint32_t rowB = event.b.row();
        const DoubleDouble shift = sense * motion.exactReachOf(event.a, event.b, axis);
        const DoubleDouble forA = motion.anchor(rowB, axis) - shift;
        const DoubleDouble forB = motion.anchor(event.a, axis) + shift;
        if (acceleration(a) == 0) {
            const double reach = magnitude(shift.high);
            motion.setStraight(event.a, axis, forA, b.velocity, b.time, now, reach);
            motion.setStraight(rowB, axis, forB, a.velocity, a.time, now, reach);
        } else {
            motion.set(event.a, axis, forA, b.velocity, b.time);
            motion.set(rowB, axis, forB, a.velocity, a.time);
        }
        return massA * magnitude(vb - va);
    }
    exchangeImpulse(va, vb, massA, massB, 1.0);
    if constexpr (Path::falls) {
        motion.setRests(event.a, axis, false);
        motion.setRests(event.b.row(), axis, false);
    }
    motion.set(event.a, axis, a.position(now), va, now);
    motion.set(event.b.row(), axis, b.position(now), vb, now);
    return massA * magnitude(va - before);
}

/// A body that falls rebounds elastically from a surface, at a time that is rounded: where it is
/// too far by then it goes back, with the speed that its energy gives it, so that neither drifts.
template <class Real, class Path>
QUADRILLE_HD inline void mirrorFall(const ExactMotion<Real, Path>& motion, std::uint32_t row,
                                    int axis, const DoubleDouble& surface, double now) {
    const Path p = motion.path(row, axis);
    const double s = now - p.time;
    const double pull = acceleration(p);
    const DoubleDouble start = motion.anchor(row, axis) - surface;
    const double beyond = start.high + (p.velocity + pull / 2 * s) * s;
    const double square = p.velocity * p.velocity - 2 * pull * (start.high + beyond);
    const double speed = p.speed(now);
    const double rebound = square > 0 ? std::sqrt(square) : magnitude(speed);
    motion.set(row, axis, surface + DoubleDouble{-beyond, 0}, speed > 0 ? -rebound : rebound, now);
}

/// The moving body of an event rebounds elastically from the static one. Returns the impulse.
template <class Real, class Path>
QUADRILLE_HD inline double bounceOff(const ExactMotion<Real, Path>& motion, const PairEvent& event,
                                     int axis, double sense) {
    const double now = event.time;
    const Path p = motion.path(event.a, axis);
    const double speed = p.speed(now);
    if (event.axes == 0) {
        const double surface = surfaceFor(motion, event, event.a, event.b, axis, sense);
        motion.set(event.a, axis, surface, -speed, now);
    } else {
        const DoubleDouble reach = motion.exactReachOf(event.a, event.b, axis);
        const DoubleDouble surface =
            DoubleDouble{motion.path(event.b, axis).anchor, 0} - sense * reach;
        if (acceleration(p) == 0) {
            const DoubleDouble mirrored = 2 * surface - motion.anchor(event.a, axis);
            motion.setStraight(event.a, axis, mirrored, -p.velocity, p.time, now, reach.high);
        } else {
            mirrorFall(motion, event.a, axis, surface, now);
        }
    }
    return static_cast<double>(motion.bodies.moving.mass[event.a]) * magnitude(2 * speed);
}

// ---- bodies that are pushed together, which collide with restitution below 1

/// One side of such a collision: what moves with the body, itself included.
struct PushedSide {
    double mass;  ///< kg
    bool held;    ///< by something that does not move
};

/// Whether a body that is pushed along the axis in a direction cannot move.
template <class Real, class Path>
QUADRILLE_HD inline bool isHeld(const ExactMotion<Real, Path>& motion, BodyRef body, int axis,
                                double sense) {
    return body.isStatic() || (motion.rests(body.row(), axis) && motion.gravity(axis) * sense > 0);
}

/// Whether a, whose path is p, pushes b along when it is pushed: they touch on that side and move
/// together.
template <class Real, class Path>
QUADRILLE_HD inline bool pushesAlong(const ExactMotion<Real, Path>& motion, std::uint32_t a,
                                     const Path& p, BodyRef b, int axis, double sense, double now) {
    const Path q = motion.path(b, axis);
    const double reach = motion.reachOf(a, b, axis);
    const double distance = (q.position(now) - p.position(now)) * sense;
    if (magnitude(distance - reach) > motion.rounding(p, q, reach, now)) return false;
    const double va = p.speed(now);
    const double vb = q.speed(now);
    if (magnitude(va - vb) > creep<Real>(va, vb, motion.restitution)) return false;
    return alongsideUntil(motion, a, b, 1 - axis, now) > now;
}

/// The velocities of two groups along an axis, px/s, when they have collided; of what is held, 0.
QUADRILLE_HD inline void collideSides(double& va, double& vb, const PushedSide& a,
                                      const PushedSide& b, double restitution) {
    const bool parts = restitution * magnitude(va - vb) >= restSpeed;
    if (a.held || b.held) {
        // One of the two is held and stands; if both are, neither has anywhere to go.
        const double rebound = parts ? restitution * (vb - va) : 0;
        va = a.held ? 0 : rebound;
        vb = b.held ? 0 : -rebound;
    } else if (parts) {
        exchangeImpulse(va, vb, a.mass, b.mass, restitution);
    } else {
        va = vb = va + b.mass / (a.mass + b.mass) * (vb - va);
    }
}

/// A body goes on with another velocity from where it is; it rests no more.
template <class Real, class Path>
QUADRILLE_HD inline void goOnWith(const ExactMotion<Real, Path>& motion, std::uint32_t row,
                                  int axis, double velocity, double now) {
    const double at = motion.path(row, axis).position(now);
    if constexpr (Path::falls) motion.setRests(row, axis, false);
    motion.set(row, axis, at, velocity, now);
}

/// Two groups collide. `moveA(velocity)` and `moveB(velocity)` let all bodies of a group go on with
/// a velocity, as goOnWith() does with one. Returns the impulse.
template <class Real, class Path, class MoveA, class MoveB>
QUADRILLE_HD inline double collideGroups(const ExactMotion<Real, Path>& motion,
                                         const PairEvent& event, int axis, const PushedSide& a,
                                         const PushedSide& b, MoveA&& moveA, MoveB&& moveB) {
    const double now = event.time;
    const double oldA = motion.path(event.a, axis).speed(now);
    const double oldB = motion.path(event.b, axis).speed(now);
    double va = oldA;
    double vb = oldB;
    collideSides(va, vb, a, b, motion.restitution);
    if (!a.held) moveA(va);
    if (!b.held) moveB(vb);
    // What is held stands, though it may have crept.
    const auto stop = [&](std::uint32_t row, double speed) {
        if (speed != 0) motion.set(row, axis, motion.path(row, axis).position(now), 0, now);
    };
    if (a.held) stop(event.a, oldA);
    if (b.held && !event.withStatic()) stop(event.b.row(), oldB);
    if (a.held && b.held) return motion.bodies.moving.mass[event.a] * magnitude(oldA);
    return a.held ? b.mass * magnitude(vb - oldB) : a.mass * magnitude(va - oldA);
}

// ---- all of them

/// Carries out one axis of an event that is no release. With restitution below 1 the collision is
/// one of groups, and left to `groups(axis, sense)`, which returns what collideGroups() does.
template <class Real, class Path, class Groups>
QUADRILLE_HD inline EventOutcome collide(const ExactMotion<Real, Path>& motion,
                                         const PairEvent& event, int axis, double sense,
                                         Groups&& groups) {
    const double now = event.time;
    const Path a = motion.path(event.a, axis);
    const Path b = motion.path(event.b, axis);
    const double va = a.speed(now);
    const double vb = b.speed(now);
    const double closing = (va - vb) * sense;
    if constexpr (Path::falls) {
        const bool aOnB = motion.gravity(axis) * sense > 0;
        const BodyRef upper = aOnB ? BodyRef::moving(event.a) : event.b;
        const BodyRef lower = aOnB ? event.b : BodyRef::moving(event.a);
        const double pressure = (a.acceleration - b.acceleration) * sense;
        const double slack = motion.rounding(a, b, motion.reachOf(event.a, event.b, axis), now);
        if (motion.holds(lower, axis) &&
            comesToRest(closing, pressure, slack, motion.restitution)) {
            const double down = aOnB ? sense : -sense;
            const double surface = surfaceFor(motion, event, upper.row(), lower, axis, down);
            motion.setRests(upper.row(), axis, true);
            motion.set(upper.row(), axis, surface, 0, now);
            const bool hits = closing * closing > 2 * pressure * slack;
            const double mass = motion.bodies.moving.mass[upper.row()];
            return {.outcome = hits ? Outcome::Collision : Outcome::Touch,
                    .rests = true,
                    .impulse = mass * magnitude(aOnB ? va : vb),
                    .approach = closing > 0 ? closing : 0};
        }
    }
    if (!(closing > creep<Real>(va, vb, motion.restitution))) return {};
    double impulse = 0;
    if (motion.restitution < 1) {
        impulse = groups(axis, sense);
    } else if (event.withStatic()) {
        impulse = bounceOff(motion, event, axis, sense);
    } else {
        impulse = exchange(motion, event, axis, sense);
    }
    const bool hits = motion.restitution == 1 || closing >= restSpeed;
    return {.outcome = hits ? Outcome::Collision : Outcome::Touch,
            .rests = false,
            .impulse = impulse,
            .approach = closing};
}

/// What an event did along both axes.
struct EventOutcomes {
    EventOutcome x, y;

    QUADRILLE_HD bool changes() const {
        return x.outcome != Outcome::Nothing || y.outcome != Outcome::Nothing;
    }
    QUADRILLE_HD bool rests() const { return x.rests || y.rests; }
    /// The axes along which the bodies collided.
    QUADRILLE_HD std::uint8_t collided() const {
        return static_cast<std::uint8_t>((x.outcome == Outcome::Collision ? axisX : 0) |
                                         (y.outcome == Outcome::Collision ? axisY : 0));
    }
};

/// Carries out an event that is no release.
template <class Real, class Path, class Groups>
QUADRILLE_HD inline EventOutcomes collide(const ExactMotion<Real, Path>& motion,
                                          const PairEvent& event, const EventContact& contact,
                                          const Groups& groups) {
    EventOutcomes done;
    if ((contact.axes & axisX) != 0) done.x = collide(motion, event, 0, contact.senseX, groups);
    if ((contact.axes & axisY) != 0) done.y = collide(motion, event, 1, contact.senseY, groups);
    return done;
}

}  // namespace quadrille
