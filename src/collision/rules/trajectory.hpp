#pragma once

#include <cmath>
#include <cstdint>

#include <quadrille/detail/host_device.hpp>

#include "collision/rules/double_double.hpp"
#include "collision/rules/pair_contact.hpp"

/// Exact motion between events, and when two boxes meet, for host and device alike.

namespace quadrille {

/// Motion along one axis without gravity: x(t) = anchor + velocity (t - time). All three change in
/// events only, so a position does not depend on how a run is cut into steps.
struct StraightPath {
    static constexpr bool falls = false;

    double anchor;    ///< px
    double velocity;  ///< px/s
    double time;      ///< s, of the anchor

    QUADRILLE_HD double position(double t) const { return anchor + velocity * (t - time); }
    QUADRILLE_HD double speed(double) const { return velocity; }
};

/// Motion along one axis under gravity: x(t) = anchor + velocity s + acceleration s^2 / 2 with s =
/// t
/// - time. A body at rest on something has no acceleration.
struct FallingPath {
    static constexpr bool falls = true;

    double anchor;        ///< px
    double velocity;      ///< px/s, at the anchor
    double time;          ///< s, of the anchor
    double acceleration;  ///< px/s^2

    QUADRILLE_HD double position(double t) const {
        const double s = t - time;
        return anchor + (velocity + acceleration / 2 * s) * s;
    }
    QUADRILLE_HD double speed(double t) const { return velocity + acceleration * (t - time); }
};

inline constexpr double never = 1e300;

/// When a distance lies within the reach: the open interval (enter, leave), empty unless enter <
/// leave.
struct Interval {
    double enter = never;
    double leave = -never;
};

/// All of them, in order of time; a parabola may pass through twice.
template <int N>
struct Intervals {
    Interval at[N];
};

/// When |distance| < reach for a distance that is d at time t0 and changes by u a second. A
/// distance that only touches the reach is outside: level edges pass each other.
QUADRILLE_HD inline Interval within(double d, double u, double t0, double reach) {
    if (u == 0) return magnitude(d) < reach ? Interval{-never, never} : Interval{};
    const double first = t0 + (-reach - d) / u;
    const double second = t0 + (reach - d) / u;
    return u > 0 ? Interval{first, second} : Interval{second, first};
}

/// t0 + distance / u, rounded once, so that the time of a meeting does not depend on where anchors
/// lie.
QUADRILLE_HD inline double timeAfter(double t0, double distance, double u) {
    const double quotient = distance / u;
    if (t0 == 0) return quotient;
    const DoubleDouble product = twoProduct(quotient, u);
    const double rest = ((distance - product.high) - product.low) / u;
    const DoubleDouble sum = twoSum(t0, quotient);
    const double time = sum.high + (sum.low + rest);
    return time == time ? time : t0 + quotient;  // of what overflows
}

/// within() with times that are rounded once.
QUADRILLE_HD inline Interval preciselyWithin(double d, double u, double t0, double reach) {
    if (u == 0) return within(d, u, t0, reach);
    const double first = timeAfter(t0, -reach - d, u);
    const double second = timeAfter(t0, reach - d, u);
    return u > 0 ? Interval{first, second} : Interval{second, first};
}

/// Roots of c + u s + a s^2 / 2 with a > 0, without cancellation: the one of larger magnitude
/// first, the other from their product (Press et al., Numerical Recipes, section 5.6). Returns
/// whether there are two.
QUADRILLE_HD inline bool roots(double c, double u, double a, double& low, double& high) {
    const double discriminant = u * u - 2 * a * c;
    if (!(discriminant > 0)) return false;
    const double root = std::sqrt(discriminant);
    const double q = u < 0 ? root - u : -root - u;
    const double first = q / a;
    const double second = 2 * c / q;
    low = first < second ? first : second;
    high = first < second ? second : first;
    return true;
}

/// The same for a distance that is accelerated by a != 0.
QUADRILLE_HD inline Intervals<2> within(double d, double u, double a, double t0, double reach) {
    // Seen so that the parabola opens upward: it is below +reach between two roots, and of that
    // interval, the part between the roots of -reach lies beyond the other face.
    const double mirror = a < 0 ? -1 : 1;
    Intervals<2> result;
    double low;
    double high;
    if (!roots(mirror * d - reach, mirror * u, mirror * a, low, high)) return result;
    result.at[0] = {t0 + low, t0 + high};
    if (roots(mirror * d + reach, mirror * u, mirror * a, low, high)) {
        result.at[1] = {t0 + high, result.at[0].leave};
        result.at[0].leave = t0 + low;
    }
    return result;
}

/// The later of two anchors: a time that only events decide about.
template <class Path>
QUADRILLE_HD inline double laterAnchor(const Path& a, const Path& b) {
    return a.time > b.time ? a.time : b.time;
}

/// When the distance from a to b along one axis is within reach, as seen from time t0. One that
/// does not change is seen from the later anchor, where it is rounded least.
QUADRILLE_HD inline Intervals<1> approach(const StraightPath& a, const StraightPath& b, double t0,
                                          double reach, double) {
    const double u = b.velocity - a.velocity;
    const double from = u == 0 ? laterAnchor(a, b) : t0;
    return {{within(b.position(from) - a.position(from), u, from, reach)}};
}

/// The same with times that are rounded once.
QUADRILLE_HD inline Intervals<1> preciseApproach(const StraightPath& a, const StraightPath& b,
                                                 double t0, double reach) {
    const double u = b.velocity - a.velocity;
    const double from = u == 0 ? laterAnchor(a, b) : t0;
    return {{preciselyWithin(b.position(from) - a.position(from), u, from, reach)}};
}

/// The same under gravity. A distance that does not change and is `slack` less than reach counts as
/// touching: rounding must not make a box trip over the edges of the floor that it slides on.
QUADRILLE_HD inline Intervals<2> approach(const FallingPath& a, const FallingPath& b, double t0,
                                          double reach, double slack) {
    const double d = b.position(t0) - a.position(t0);
    const double u = b.speed(t0) - a.speed(t0);
    const double acceleration = b.acceleration - a.acceleration;
    if (acceleration != 0) return within(d, u, acceleration, t0, reach);
    return {{within(d, u, t0, u == 0 ? reach - slack : reach), {}}};
}

/// Whether the distance is within reach at any time from `from` to `to`.
template <int N>
QUADRILLE_HD inline bool touches(const Intervals<N>& intervals, double from, double to) {
    bool any = false;
    for (const Interval& i : intervals.at) {
        any = any || (i.enter <= to && i.leave > from && i.enter < i.leave);
    }
    return any;
}

/// A meeting of two boxes.
struct Meeting {
    double time;        ///< `never` if they do not meet
    std::uint8_t axes;  ///< axisX, axisY, or both at a corner
};

/// When the boxes next begin to overlap, from `from` on: both axes are within reach, and the one
/// that came last is the axis of the contact.
template <int N>
QUADRILLE_HD inline Meeting meet(const Intervals<N>& x, const Intervals<N>& y, double from) {
    Meeting first{never, 0};
    for (const Interval& i : x.at) {
        for (const Interval& j : y.at) {
            const double enter = i.enter > j.enter ? i.enter : j.enter;
            const double leave = i.leave < j.leave ? i.leave : j.leave;
            if (!(enter >= from && enter < leave && enter < first.time)) continue;
            first = {enter, static_cast<std::uint8_t>((i.enter == enter ? axisX : 0) |
                                                      (j.enter == enter ? axisY : 0))};
        }
    }
    return first;
}

/// Until when the distance, within reach at time t, stays so; -never if it is not.
template <int N>
QUADRILLE_HD inline double insideUntil(const Intervals<N>& intervals, double t) {
    double until = -never;
    for (const Interval& i : intervals.at) {
        if (i.enter <= t && t < i.leave) until = i.leave;
    }
    return until;
}

}  // namespace quadrille
