#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include <quadrille/body_ref.hpp>
#include <quadrille/detail/host_device.hpp>

#include "collision/rules/bodies.hpp"
#include "collision/rules/double_double.hpp"
#include "collision/rules/pair_contact.hpp"
#include "collision/rules/trajectory.hpp"

/// On which path each body of the law `continuous` is, for host and device alike.

namespace quadrille {

/// The distance from 1 to the next number, as a constant that device code may use.
template <class Real>
inline constexpr double machineEpsilon = std::numeric_limits<Real>::epsilon();

QUADRILLE_HD inline double acceleration(const StraightPath&) { return 0; }
QUADRILLE_HD inline double acceleration(const FallingPath& path) { return path.acceleration; }

QUADRILLE_HD inline constexpr std::uint8_t axisBit(int axis) { return axis == 0 ? axisX : axisY; }

/// What is so much of its touching distance nearer or farther still touches: far above what
/// rounding adds up to in many events, far below what can be seen.
inline constexpr double touchTolerance = 1e-9;

/// An anchor is moved along its path when an event finds it more than so many times as far away as
/// the body's touching distance and its distance from the origin: then positions have nearly all
/// digits that places so far from the origin can have.
inline constexpr double longestWay = 64;

/// The paths of all bodies along the axes 0 (x) and 1 (y), in double precision, and what decides
/// about them. A moving body is its row.
template <class Real, class PathOfAxis>
struct ExactMotion {
    using Path = PathOfAxis;
    static constexpr bool falls = Path::falls;

    /// A path along each axis.
    struct Paths {
        Path along[2];
    };

    Bodies<Real> bodies;        ///< with `anchors`, and with `rests` where they fall
    double gravityX, gravityY;  ///< px/s^2
    double restitution;         ///< in [0, 1]

    QUADRILLE_HD double gravity(int axis) const { return axis == 0 ? gravityX : gravityY; }

    QUADRILLE_HD Path path(std::uint32_t row, int axis) const {
        const Anchor<Real>& from = bodies.moving.anchors[row];
        Path result{};
        result.anchor = axis == 0 ? from.x : from.y;
        if constexpr (sizeof(Real) < sizeof(double)) {
            result.anchor += static_cast<double>(axis == 0 ? from.lowX : from.lowY);
        }
        result.velocity = axis == 0 ? from.vx : from.vy;
        result.time = axis == 0 ? from.timeX : from.timeY;
        if constexpr (falls) result.acceleration = rests(row, axis) ? 0 : gravity(axis);
        return result;
    }
    QUADRILLE_HD Path path(BodyRef body, int axis) const {
        if (!body.isStatic()) return path(body.row(), axis);
        Path result{};
        result.anchor = (axis == 0 ? bodies.fixed.x : bodies.fixed.y)[body.row()];
        return result;
    }

    template <class Body>
    QUADRILLE_HD Paths paths(Body body) const {
        return {{path(body, 0), path(body, 1)}};
    }

    /// The anchor with all its digits, px.
    QUADRILLE_HD DoubleDouble anchor(std::uint32_t row, int axis) const {
        const Anchor<Real>& from = bodies.moving.anchors[row];
        return {axis == 0 ? from.x : from.y, axis == 0 ? from.lowX : from.lowY};
    }

    /// Puts a body on another path along an axis. Its velocity in the columns follows here, and
    /// where bodies fall, in place().
    QUADRILLE_HD void set(std::uint32_t row, int axis, const DoubleDouble& anchor, double velocity,
                          double time) const {
        const auto& m = bodies.moving;
        Anchor<Real>& to = m.anchors[row];
        const auto high = static_cast<Real>(anchor.high);
        const double low = (anchor.high - static_cast<double>(high)) + anchor.low;
        (axis == 0 ? to.x : to.y) = high;
        (axis == 0 ? to.lowX : to.lowY) = static_cast<float>(low);
        (axis == 0 ? to.vx : to.vy) = static_cast<Real>(velocity);
        (axis == 0 ? to.timeX : to.timeY) = time;
        if constexpr (!falls) (axis == 0 ? m.vx : m.vy)[row] = static_cast<Real>(velocity);
    }
    QUADRILLE_HD void set(std::uint32_t row, int axis, double anchor, double velocity,
                          double time) const {
        set(row, axis, DoubleDouble{anchor, 0}, velocity, time);
    }

    /// Puts a body back on the path that an anchor is of.
    QUADRILLE_HD void takeBack(std::uint32_t row, const Anchor<Real>& before) const {
        const auto& m = bodies.moving;
        m.anchors[row] = before;
        if constexpr (!falls) {
            m.vx[row] = before.vx;
            m.vy[row] = before.vy;
        }
    }

    /// Puts a body on another straight path, with an anchor as near as need be. It is moved to a
    /// time on a coarse grid of powers of two, so that few digits are added: on a lattice of
    /// doubles none is lost, elsewhere so little that millions of times are not seen.
    QUADRILLE_HD void setStraight(std::uint32_t row, int axis, DoubleDouble anchor, double velocity,
                                  double time, double now, double reach) const {
        constexpr double mostSpeed = 1e200;  // products of faster ones may overflow
        const double way = velocity * (now - time);
        const double room = longestWay * (magnitude(anchor.high + way) + reach);
        if (magnitude(way) > room && magnitude(velocity) < mostSpeed) {
            const double grid = std::ldexp(1.0, std::ilogb(now - time) - 5);
            const double later = std::floor(now / grid) * grid;
            const DoubleDouble passed = twoSum(later, -time);
            anchor =
                anchor + twoProduct(velocity, passed.high) + DoubleDouble{velocity * passed.low, 0};
            time = later;
        }
        set(row, axis, anchor, velocity, time);
    }

    /// Writes into the columns where a body is at time t.
    QUADRILLE_HD void place(std::uint32_t row, double t) const {
        const auto& m = bodies.moving;
        const Paths at = paths(row);
        m.x[row] = static_cast<Real>(at.along[0].position(t));
        m.y[row] = static_cast<Real>(at.along[1].position(t));
        if constexpr (falls) {
            m.vx[row] = static_cast<Real>(at.along[0].speed(t));
            m.vy[row] = static_cast<Real>(at.along[1].speed(t));
        }
    }

    /// Whether a body is where place() would put it, to the last bit.
    QUADRILLE_HD bool isPlaced(std::uint32_t row, double t) const {
        const auto& m = bodies.moving;
        const Paths at = paths(row);
        return static_cast<Real>(at.along[0].position(t)) == m.x[row] &&
               static_cast<Real>(at.along[1].position(t)) == m.y[row] &&
               static_cast<Real>(at.along[0].speed(t)) == m.vx[row] &&
               static_cast<Real>(at.along[1].speed(t)) == m.vy[row];
    }

    /// The distance of the centres of two bodies when they touch, px.
    QUADRILLE_HD double reachOf(std::uint32_t a, BodyRef b, int axis) const {
        return halfOf(BodyRef::moving(a), axis) + halfOf(b, axis);
    }
    /// The same with all digits.
    QUADRILLE_HD DoubleDouble exactReachOf(std::uint32_t a, BodyRef b, int axis) const {
        return twoSum(halfOf(BodyRef::moving(a), axis), halfOf(b, axis));
    }

    QUADRILLE_HD double halfOf(BodyRef body, int axis) const {
        const auto& own = axis == 0 ? bodies.moving.halfWidth : bodies.moving.halfHeight;
        const auto& fixed = axis == 0 ? bodies.fixed.halfWidth : bodies.fixed.halfHeight;
        return body.isStatic() ? fixed[body.row()] : own[body.row()];
    }

    /// A distance that may come from the rounding of positions and of times, px.
    QUADRILLE_HD static double rounding(const Path& a, const Path& b, double reach, double now) {
        constexpr double eps = 8 * machineEpsilon<Real>;
        constexpr double epsTime = 8 * machineEpsilon<double>;
        return touchTolerance * reach +
               eps * (magnitude(a.position(now)) + magnitude(b.position(now)) + reach) +
               epsTime * magnitude(now) * (magnitude(a.speed(now)) + magnitude(b.speed(now)));
    }

    /// Whether the body rests on something along the axis, and does not fall.
    QUADRILLE_HD bool rests(std::uint32_t row, int axis) const {
        if constexpr (!falls) return false;
        return (bodies.moving.rests[row] & axisBit(axis)) != 0;
    }

    QUADRILLE_HD void setRests(std::uint32_t row, int axis, bool rests) const {
        std::uint8_t& bits = bodies.moving.rests[row];
        const auto others = static_cast<std::uint8_t>(bits & ~axisBit(axis));
        bits = static_cast<std::uint8_t>(others | (rests ? axisBit(axis) : 0));
    }

    /// Whether the body stays where it is along the axis, whatever rests on it.
    QUADRILLE_HD bool holds(BodyRef body, int axis) const {
        return body.isStatic() || rests(body.row(), axis);
    }
};

/// Whether two bodies are side by side: within reach of each other along the axis, and for how
/// long, s; -never if not.
template <class Real, class Path>
QUADRILLE_HD inline double alongsideUntil(const ExactMotion<Real, Path>& motion, std::uint32_t a,
                                          BodyRef b, int axis, double now) {
    const Path p = motion.path(a, axis);
    const Path q = motion.path(b, axis);
    const double reach = motion.reachOf(a, b, axis);
    const double slack = motion.rounding(p, q, reach, now);
    return insideUntil(approach(p, q, laterAnchor(p, q), reach, slack), now);
}

/// How fast bodies may be along either axis for the partition to cover them, px/s.
struct SpeedBounds {
    double common = 0;
    const double* own = nullptr;  ///< of each moving row; null if all have the common one

    QUADRILLE_HD double operator[](std::uint32_t row) const {
        return own != nullptr ? own[row] : common;
    }
};

/// Whether a body may become faster than its bound before time `until`: then a partition that
/// covers the bounds until then may not show all that it meets.
template <class Real, class Path>
QUADRILLE_HD inline bool outruns(const ExactMotion<Real, Path>& motion, std::uint32_t row,
                                 double now, double until, const SpeedBounds& bounds) {
    for (int axis = 0; axis < 2; ++axis) {
        const Path p = motion.path(row, axis);
        const double speed = magnitude(p.speed(now)) + magnitude(acceleration(p)) * (until - now);
        if (!(speed <= bounds[row])) return true;  // NaN is no speed
    }
    return false;
}

}  // namespace quadrille
