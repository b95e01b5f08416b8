#pragma once

#include <cstdint>

#include <quadrille/body_ref.hpp>
#include <quadrille/detail/host_device.hpp>

#include "collision/rules/pair_contact.hpp"
#include "collision/rules/paths.hpp"
#include "collision/rules/trajectory.hpp"

/// What holds bodies that fall, for host and device alike: who rests on whom, and until when.
///
/// A rebound off something that holds is none if gravity would bring it back before it left the
/// touching distance: the body then rests, without acceleration. That begins in `collide`
/// (event_rules.hpp). It ends when the body is hit (the same), when its last support ends
/// (`findRest`, next_event.hpp), when a support has changed (`RestEnds`), and when somebody edits
/// the body (`ContinuousLaw::setOut`). With the law `impulse` nothing rests: a contact with a
/// static box takes what gravity has brought (`collideStatic`, pair_contact.hpp).

namespace quadrille {

/// Until when `upper` stands over `lower`, which it touches along the axis; -never if it does not.
template <class Real, class Path>
QUADRILLE_HD inline double restsUntil(const ExactMotion<Real, Path>& motion, std::uint32_t upper,
                                      BodyRef lower, int axis, double now) {
    const Path p = motion.path(upper, axis);
    const Path q = motion.path(lower, axis);
    const double reach = motion.reachOf(upper, lower, axis);
    const double distance = q.position(now) - p.position(now);
    if (!(distance * motion.gravity(axis) > 0)) return -never;
    const double rounding = motion.rounding(p, q, reach, now);
    const double depth = reach - magnitude(distance);
    if (depth < -rounding) return -never;
    if (depth > rounding) {
        // Deep inside, it rests on what is nearest to being left along this axis.
        const int other = 1 - axis;
        const double across =
            motion.path(lower, other).position(now) - motion.path(upper, other).position(now);
        if (motion.reachOf(upper, lower, other) - magnitude(across) <= depth) return -never;
    }
    return alongsideUntil(motion, upper, lower, 1 - axis, now);
}

/// Whether what meets at a speed of `closing`, pressed together by an acceleration, does not rise
/// above the rounding of positions any more.
QUADRILLE_HD inline bool comesToRest(double closing, double pressure, double rounding,
                                     double restitution) {
    const double parting = closing > 0 ? restitution * closing : closing;
    return pressure > 0 && parting * parting <= 2 * pressure * rounding;
}

/// Whether one of the bodies that `row` may meet holds it up.
template <class Real, class Path, class Others>
QUADRILLE_HD inline bool supported(const ExactMotion<Real, Path>& motion, std::uint32_t row,
                                   const Others& others, int axis, double now) {
    for (const BodyRef b : others) {
        if (motion.holds(b, axis) && restsUntil(motion, row, b, axis, now) > now) return true;
    }
    return false;
}

/// Whether `upper` rests, and may do so on `lower`, as far as can be seen along the axis.
template <class Real, class Path>
QUADRILLE_HD inline bool mayLieOn(const ExactMotion<Real, Path>& motion, std::uint32_t upper,
                                  std::uint32_t lower, int axis, double now) {
    if (!motion.rests(upper, axis)) return false;
    // What rested on a body that has left lies where that body was, at most a rebound away.
    if (!motion.rests(lower, axis)) return true;
    const double distance =
        motion.path(lower, axis).position(now) - motion.path(upper, axis).position(now);
    const double reach = motion.reachOf(upper, BodyRef::moving(lower), axis);
    return distance * motion.gravity(axis) > 0 && magnitude(distance) < reach * (1 + 1e-6);
}

/// Lets a body fall that rested, if none of those that it may meet holds it any more. Returns
/// whether it does.
template <class Real, class Path, class Others>
QUADRILLE_HD inline bool release(const ExactMotion<Real, Path>& motion, std::uint32_t row,
                                 const Others& others, int axis, double now) {
    if (!motion.rests(row, axis) || supported(motion, row, others, axis, now)) return false;
    const double at = motion.path(row, axis).position(now);
    motion.setRests(row, axis, false);
    motion.set(row, axis, at, 0, now);
    return true;
}

}  // namespace quadrille
