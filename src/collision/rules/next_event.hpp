#pragma once

#include <cstdint>

#include <quadrille/body_ref.hpp>
#include <quadrille/detail/host_device.hpp>

#include "collision/rules/event_order.hpp"
#include "collision/rules/pair_contact.hpp"
#include "collision/rules/paths.hpp"
#include "collision/rules/rest_rules.hpp"
#include "collision/rules/trajectory.hpp"

/// What happens next to a pair of bodies, for host and device alike. Events are handed on as
/// `emit(PairEvent)`, without stamps.

namespace quadrille {

// ---- most pairs do not come near each other

/// Whether a distance d that changes by u a second comes within reach during a time h: takes no
/// division, and is true for few.
template <class Number>
QUADRILLE_HD inline bool comesNear(Number d, Number u, Number reach, Number h, Number slack) {
    const Number half = u * (h / 2);
    return magnitude(d + half) < reach + magnitude(half) + slack;
}

/// Room in comesNear() for gravity, for what touches, and for the rounding of positions and times,
/// px.
template <class Real, class Path>
QUADRILLE_HD inline double nearSlack(const ExactMotion<Real, Path>& motion, int axis,
                                     double position, double reach, double u, double h, double to) {
    constexpr double eps = 16 * machineEpsilon<Real>;
    constexpr double epsTime = 16 * machineEpsilon<double>;
    const double room = eps * (position + reach) + magnitude(u) * (eps * h + epsTime * to);
    if constexpr (!Path::falls) return room;
    return room + touchTolerance * reach + magnitude(motion.gravity(axis)) * h * h;
}

/// Whether two moving bodies come near each other along an axis until `to`, a time h after that of
/// the positions and velocities in the columns.
template <class Real, class Path>
QUADRILLE_HD inline bool comesNear(const ExactMotion<Real, Path>& motion, std::uint32_t a,
                                   std::uint32_t b, int axis, Real h, double to) {
    const auto& m = motion.bodies.moving;
    const Real* const position = axis == 0 ? m.x : m.y;
    const Real* const velocity = axis == 0 ? m.vx : m.vy;
    const SharedColumn<Real>& half = axis == 0 ? m.halfWidth : m.halfHeight;
    const Real u = velocity[b] - velocity[a];
    const Real reach = half[a] + half[b];
    const double slack = nearSlack(motion, axis, magnitude(position[a]), reach, u, h, to);
    return comesNear(position[b] - position[a], u, reach, h, static_cast<Real>(slack));
}

// ---- what happens to those that do

/// A pair that overlaps, at the event's time, collides there and then if it approaches along its
/// axis of least penetration; or, if gravity makes it turn inside, at the turn.
template <class Real, class Path, class Emit>
QUADRILLE_HD inline void findOverlap(const ExactMotion<Real, Path>& motion, PairEvent event,
                                     double until, double to, bool afterEvent, Emit&& emit) {
    const double from = event.time;
    const auto a = motion.paths(event.a);
    const auto b = motion.paths(event.b);
    const auto least =
        leastPenetration(b.along[0].position(from) - a.along[0].position(from),
                         b.along[1].position(from) - a.along[1].position(from),
                         motion.reachOf(event.a, event.b, 0), motion.reachOf(event.a, event.b, 1));
    const int axis = least.axis == axisX ? 0 : 1;
    const Path& p = a.along[axis];
    const Path& q = b.along[axis];
    const double closing = (p.speed(from) - q.speed(from)) * least.sense;
    if (afterEvent && closing > 0) {
        emit(event);
        return;
    }
    if constexpr (Path::falls) {
        const double pressure = (p.acceleration - q.acceleration) * least.sense;
        if (!(pressure > 0)) return;
        const double t0 = p.time < q.time ? q.time : p.time;
        event.time = t0 - (p.speed(t0) - q.speed(t0)) * least.sense / pressure;
        if (afterEvent && event.time < from) event.time = from;
        if (event.time < until && event.time <= to &&
            (event.time > from || (afterEvent && event.time == from))) {
            emit(event);
        }
    }
}

/// A pair that touches along gravity: the upper one comes to rest there and then, at the event's
/// time, or slides off later.
template <class Real, class Path, class Emit>
QUADRILLE_HD inline void findRest(const ExactMotion<Real, Path>& motion, PairEvent event, double to,
                                  bool afterEvent, Emit&& emit) {
    const double from = event.time;
    const auto a = motion.paths(event.a);
    const auto b = motion.paths(event.b);
    for (int axis = 0; axis < 2; ++axis) {
        const double gravity = motion.gravity(axis);
        if (gravity == 0) continue;
        const Path& p = a.along[axis];
        const Path& q = b.along[axis];
        const double distance = q.position(from) - p.position(from);
        const double sense = distance >= 0 ? 1 : -1;
        const bool onTop = gravity * sense > 0;  // a on b
        const BodyRef upper = onTop ? BodyRef::moving(event.a) : event.b;
        const BodyRef lower = onTop ? event.b : BodyRef::moving(event.a);
        if (upper.isStatic() || !motion.holds(lower, axis)) continue;
        const double until = restsUntil(motion, upper.row(), lower, axis, from);
        if (!(until > from)) continue;
        event.axes = axisBit(axis);
        if (motion.rests(upper.row(), axis)) {
            event.time = until;
            event.release = true;
            if (until <= to) emit(event);
        } else if (afterEvent) {
            const double reach = motion.reachOf(event.a, event.b, axis);
            const double closing = (p.speed(from) - q.speed(from)) * sense;
            event.time = from;
            event.release = false;
            const double slack = motion.rounding(p, q, reach, from);
            if (comesToRest(closing, magnitude(gravity), slack, motion.restitution)) emit(event);
        }
    }
}

/// What happens next, until `to`, to body `row`, whose paths are given, and another, from `from`
/// on. After an event, at time `from`, a pair that overlaps or touches already is looked at there
/// and then; it is asked only there, so that the answer does not depend on where steps begin.
template <class Real, class Path, class Emit>
QUADRILLE_HD inline void findNext(const ExactMotion<Real, Path>& motion, std::uint32_t row,
                                  const typename ExactMotion<Real, Path>::Paths& own, BodyRef b,
                                  const typename ExactMotion<Real, Path>::Paths& other, double from,
                                  double to, bool afterEvent, Emit&& emit) {
    double slackX = 0;
    double slackY = 0;
    const double reachX = motion.reachOf(row, b, 0);
    const double reachY = motion.reachOf(row, b, 1);
    if constexpr (Path::falls) {
        slackX = motion.rounding(own.along[0], other.along[0], reachX, from);
        slackY = motion.rounding(own.along[1], other.along[1], reachY, from);
        findRest(motion, pairEvent(motion.bodies, row, b, from), to, afterEvent, emit);
    }
    double seenX = laterAnchor(own.along[0], other.along[0]);
    double seenY = laterAnchor(own.along[1], other.along[1]);
    if constexpr (!Path::falls) {
        // From one time along both axes, so that a corner is hit along both at one time.
        seenX = seenY = seenX > seenY ? seenX : seenY;
    }
    // Most pairs are told apart by times that are off by their last digits.
    constexpr double eps = 4 * machineEpsilon<double>;
    const double early = from - eps * magnitude(from);
    const double late = to + eps * magnitude(to);
    auto x = approach(own.along[0], other.along[0], seenX, reachX, slackX);
    if (!touches(x, early, late)) return;
    auto y = approach(own.along[1], other.along[1], seenY, reachY, slackY);
    if (!touches(y, early, late)) return;
    if constexpr (!Path::falls) {
        if (seenX != 0) {
            x = preciseApproach(own.along[0], other.along[0], seenX, reachX);
            y = preciseApproach(own.along[1], other.along[1], seenY, reachY);
        }
    }
    const Meeting meeting = meet(x, y, from);
    if (meeting.time <= to) {
        PairEvent met = pairEvent(motion.bodies, row, b, meeting.time);
        met.axes = meeting.axes;
        emit(met);
    }
    if ((!afterEvent && !Path::falls) || meeting.time == from) return;
    const double untilX = insideUntil(x, from);
    const double untilY = insideUntil(y, from);
    if (untilX > from && untilY > from) {
        findOverlap(motion, pairEvent(motion.bodies, row, b, from),
                    untilY < untilX ? untilY : untilX, to, afterEvent, emit);
    }
}

/// What happens to two candidates from `from`, the time of the columns, until `to`.
template <class Real, class Path, class Emit>
QUADRILLE_HD inline void findBetween(const ExactMotion<Real, Path>& motion, std::uint32_t a,
                                     BodyRef b, double from, double to, Emit&& emit) {
    if (!b.isStatic()) {
        const Real h = static_cast<Real>(to - from);
        if (!comesNear(motion, a, b.row(), 0, h, to)) return;
        if (!comesNear(motion, a, b.row(), 1, h, to)) return;
    }
    findNext(motion, a, motion.paths(a), b, motion.paths(b), from, to, false, emit);
}

/// What happens until `to` to a body that an event changed at time `now` and to some of those that
/// it may meet.
template <class Real, class Path, class Others, class Emit>
QUADRILLE_HD inline void findFor(const ExactMotion<Real, Path>& motion, std::uint32_t row,
                                 const Others& others, double now, double to, Emit&& emit) {
    const auto own = motion.paths(row);
    const double at[2] = {own.along[0].position(now), own.along[1].position(now)};
    const double velocity[2] = {own.along[0].speed(now), own.along[1].speed(now)};
    const double h = to - now;
    for (const BodyRef b : others) {
        const auto other = motion.paths(b);
        bool near = true;
        for (int axis = 0; axis < 2 && near; ++axis) {
            const double d = other.along[axis].position(now) - at[axis];
            const double u = other.along[axis].speed(now) - velocity[axis];
            const double reach = motion.reachOf(row, b, axis);
            const double slack = nearSlack(motion, axis, magnitude(at[axis]), reach, u, h, to);
            near = comesNear(d, u, reach, h, slack);
        }
        if (near) findNext(motion, row, own, b, other, now, to, true, emit);
    }
}

}  // namespace quadrille
