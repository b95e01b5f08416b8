#pragma once

#include <cstdint>

#include "collision/contact_law.hpp"
#include "collision/host_device.hpp"

/// Exact motion between events, and when two boxes meet, for host and device alike.

namespace quadrille {

/// Motion along one axis: x(t) = anchor + velocity (t - time) + acceleration (t - time)^2 / 2. All
/// four change in events only, so a position does not depend on how a run is cut into steps.
struct Trajectory {
    double anchor;        ///< px
    double velocity;      ///< px/s, at the anchor
    double time;          ///< s, of the anchor
    double acceleration;  ///< px/s^2

    QUADRILLE_HD double position(double t) const {
        const double s = t - time;
        if (acceleration == 0) return anchor + velocity * s;
        return anchor + (velocity + acceleration / 2 * s) * s;
    }
    QUADRILLE_HD double speed(double t) const {
        return acceleration == 0 ? velocity : velocity + acceleration * (t - time);
    }
};

inline constexpr double never = 1e300;

/// When a distance lies within the reach: the open intervals (enter, leave), at most two, in order.
struct Intervals {
    int count = 0;
    double enter[2] = {never, never};
    double leave[2] = {never, never};
};

/// When |distance| < reach for a distance that is d at time t0 and changes by u a second. A distance
/// that only touches the reach is outside: level edges pass each other.
QUADRILLE_HD inline Intervals within(double d, double u, double t0, double reach) {
    Intervals result;
    if (u == 0) {
        if (magnitude(d) < reach) {
            result.count = 1;
            result.enter[0] = -never;
        }
        return result;
    }
    const double first = t0 + (-reach - d) / u;
    const double second = t0 + (reach - d) / u;
    result.count = 1;
    result.enter[0] = u > 0 ? first : second;
    result.leave[0] = u > 0 ? second : first;
    return result;
}

/// Real roots of d + u s + a s^2 / 2 in ascending order, without cancellation (Kahan: the larger
/// root by magnitude first, the other from their product). Returns how many there are.
QUADRILLE_HD inline int roots(double d, double u, double a, double out[2]) {
    const double discriminant = u * u - 2 * a * d;
    if (!(discriminant > 0)) return 0;
    const double q = u < 0 ? -u + std::sqrt(discriminant) : -u - std::sqrt(discriminant);
    const double first = q / a;
    const double second = 2 * d / q;
    out[0] = first < second ? first : second;
    out[1] = first < second ? second : first;
    return 2;
}

/// When |distance| < reach for a distance that is d at t0, changes by u a second there, and is
/// accelerated by a: the distance of a falling box from a static one.
QUADRILLE_HD inline Intervals withinFalling(double d, double u, double a, double t0, double reach) {
    if (a == 0) return within(d, u, t0, reach);
    // Mirrored so that the parabola opens upward: it is below +reach between two roots, and of
    // that interval, the part between the roots of -reach is beyond the other face.
    const double mirror = a < 0 ? -1 : 1;
    double outer[2];
    double inner[2];
    Intervals result;
    if (roots(mirror * d - reach, mirror * u, mirror * a, outer) == 0) return result;
    result.count = 1;
    result.enter[0] = t0 + outer[0];
    result.leave[0] = t0 + outer[1];
    if (roots(mirror * d + reach, mirror * u, mirror * a, inner) == 2) {
        result.count = 2;
        result.leave[1] = result.leave[0];
        result.leave[0] = t0 + inner[0];
        result.enter[1] = t0 + inner[1];
    }
    return result;
}

/// The distance from a to b along one axis, when it is within reach.
QUADRILLE_HD inline Intervals approach(const Trajectory& a, const Trajectory& b, double reach) {
    // Seen from the later anchor: a time that only events decide about.
    const double t0 = a.time > b.time ? a.time : b.time;
    return withinFalling(b.position(t0) - a.position(t0), b.speed(t0) - a.speed(t0),
                         b.acceleration - a.acceleration, t0, reach);
}

/// A meeting of two boxes.
struct Meeting {
    double time;        ///< `never` if they do not meet
    std::uint8_t axes;  ///< axisX, axisY, or both at a corner
};

/// The first time from `from` on at which the boxes begin to overlap: both axes within reach, the
/// one that came last being the axis of the contact.
QUADRILLE_HD inline Meeting meet(const Intervals& x, const Intervals& y, double from) {
    Meeting first{never, 0};
    for (int i = 0; i < x.count; ++i) {
        for (int j = 0; j < y.count; ++j) {
            const double enter = x.enter[i] > y.enter[j] ? x.enter[i] : y.enter[j];
            const double leave = x.leave[i] < y.leave[j] ? x.leave[i] : y.leave[j];
            if (!(enter >= from && enter < leave && enter < first.time)) continue;
            first.time = enter;
            first.axes = static_cast<std::uint8_t>((x.enter[i] == enter ? axisX : 0) |
                                                   (y.enter[j] == enter ? axisY : 0));
        }
    }
    return first;
}

/// Whether the boxes overlap at time t, having begun to before.
QUADRILLE_HD inline bool overlapAt(const Intervals& x, const Intervals& y, double t) {
    bool inX = false;
    bool inY = false;
    for (int i = 0; i < x.count; ++i) inX = inX || (x.enter[i] < t && t < x.leave[i]);
    for (int j = 0; j < y.count; ++j) inY = inY || (y.enter[j] < t && t < y.leave[j]);
    return inX && inY;
}

}  // namespace quadrille
