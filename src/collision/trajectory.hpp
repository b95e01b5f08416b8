#pragma once

#include <cstdint>

#include "collision/contact_law.hpp"
#include "collision/host_device.hpp"

/// Exact motion between events, and when two boxes meet, for host and device alike.

namespace quadrille {

/// Motion along one axis: x(t) = anchor + velocity (t - time). All three change in events only, so
/// a position does not depend on how a run is cut into steps.
struct Trajectory {
    double anchor;    ///< px
    double velocity;  ///< px/s
    double time;      ///< s, of the anchor

    QUADRILLE_HD double position(double t) const { return anchor + velocity * (t - time); }
};

inline constexpr double never = 1e300;

/// When a distance lies within the reach: the open interval (enter, leave), empty unless enter <
/// leave.
struct Interval {
    double enter = never;
    double leave = -never;
};

/// When |distance| < reach for a distance that is d at time t0 and changes by u a second. A
/// distance that only touches the reach is outside: level edges pass each other.
QUADRILLE_HD inline Interval within(double d, double u, double t0, double reach) {
    if (u == 0) return magnitude(d) < reach ? Interval{-never, never} : Interval{};
    const double first = t0 + (-reach - d) / u;
    const double second = t0 + (reach - d) / u;
    return u > 0 ? Interval{first, second} : Interval{second, first};
}

/// When the distance from a to b along one axis is within reach.
QUADRILLE_HD inline Interval approach(const Trajectory& a, const Trajectory& b, double reach) {
    // Seen from the later anchor: a time that only events decide about.
    const double t0 = a.time > b.time ? a.time : b.time;
    return within(b.position(t0) - a.position(t0), b.velocity - a.velocity, t0, reach);
}

/// Whether the distance is within reach at any time from `from` to `to`.
QUADRILLE_HD inline bool touches(const Interval& i, double from, double to) {
    return i.enter <= to && i.leave > from && i.enter < i.leave;
}

/// A meeting of two boxes.
struct Meeting {
    double time;        ///< `never` if they do not meet
    std::uint8_t axes;  ///< axisX, axisY, or both at a corner
};

/// When the boxes begin to overlap, from `from` on: both axes are within reach, and the one that
/// came last is the axis of the contact.
QUADRILLE_HD inline Meeting meet(const Interval& x, const Interval& y, double from) {
    const double enter = x.enter > y.enter ? x.enter : y.enter;
    const double leave = x.leave < y.leave ? x.leave : y.leave;
    if (!(enter >= from && enter < leave)) return {never, 0};
    return {enter, static_cast<std::uint8_t>((x.enter == enter ? axisX : 0) |
                                             (y.enter == enter ? axisY : 0))};
}

/// Whether the boxes overlap at time t, having begun to before.
QUADRILLE_HD inline bool overlapAt(const Interval& x, const Interval& y, double t) {
    return x.enter < t && t < x.leave && y.enter < t && t < y.leave;
}

}  // namespace quadrille
