#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <quadrille/bodies.hpp>

#include "collision/continuous/event_queue.hpp"
#include "collision/rules/trajectory.hpp"

namespace quadrille {

inline double acceleration(const StraightPath&) { return 0; }
inline double acceleration(const FallingPath& path) { return path.acceleration; }

inline constexpr std::uint8_t axisBit(int axis) { return axis == 0 ? axisX : axisY; }

/// The paths of all bodies along the axes 0 (x) and 1 (y), in double precision. A body is a row, or
/// the row of a static one with PairEvent::staticBit.
template <class Real, class Path>
class Trajectories {
  public:
    static constexpr bool falls = Path::falls;

    /// A path along each axis.
    struct Paths {
        std::array<Path, 2> along;
    };

    /// `bodies` must outlive this; gravity in px/s^2.
    Trajectories(const BodyView<Real>& bodies, const std::array<double, 2>& gravity)
        : bodies_(bodies), gravity_(gravity) {}

    const BodyView<Real>& bodies() const { return bodies_; }
    const auto& moving() const { return bodies_.moving; }
    double gravity(int axis) const { return gravity_[static_cast<std::size_t>(axis)]; }
    static bool isStatic(std::uint32_t body) { return (body & PairEvent::staticBit) != 0; }

    Path path(std::uint32_t body, int axis) const {
        Path result{};
        if (isStatic(body)) {
            const std::uint32_t k = body & ~PairEvent::staticBit;
            result.anchor = axis == 0 ? bodies_.fixed.x[k] : bodies_.fixed.y[k];
            return result;
        }
        const Anchor<Real>& from = bodies_.moving.anchors->rows[body];
        result.anchor = axis == 0 ? from.x : from.y;
        result.velocity = axis == 0 ? from.vx : from.vy;
        result.time = axis == 0 ? from.timeX : from.timeY;
        if constexpr (falls) result.acceleration = rests(body, axis) ? 0 : gravity(axis);
        return result;
    }

    Paths paths(std::uint32_t body) const { return {{path(body, 0), path(body, 1)}}; }

    /// The distance of the centres of `a`, which moves, and `b` when they touch, px.
    double reachOf(std::uint32_t a, std::uint32_t b, int axis) const {
        const auto& own = axis == 0 ? bodies_.moving.halfWidth : bodies_.moving.halfHeight;
        const auto& fixed = axis == 0 ? bodies_.fixed.halfWidth : bodies_.fixed.halfHeight;
        const double half = isStatic(b) ? fixed[b & ~PairEvent::staticBit] : own[b];
        return static_cast<double>(own[a]) + half;
    }

    /// A distance that may come from the rounding of positions and of times, px.
    static double rounding(const Path& a, const Path& b, double reach, double now) {
        constexpr double eps = 8 * static_cast<double>(std::numeric_limits<Real>::epsilon());
        constexpr double epsTime = 8 * std::numeric_limits<double>::epsilon();
        return eps * (std::abs(a.position(now)) + std::abs(b.position(now)) + reach) +
               epsTime * std::abs(now) * (std::abs(a.speed(now)) + std::abs(b.speed(now)));
    }

    void set(std::uint32_t row, int axis, double anchor, double velocity, double time) const {
        const auto& m = bodies_.moving;
        Anchor<Real>& to = m.anchors->rows[row];
        (axis == 0 ? to.x : to.y) = static_cast<Real>(anchor);
        (axis == 0 ? to.vx : to.vy) = static_cast<Real>(velocity);
        (axis == 0 ? to.timeX : to.timeY) = time;
        if constexpr (!falls) (axis == 0 ? m.vx : m.vy)[row] = static_cast<Real>(velocity);
    }

    // ---- bodies at rest

    bool rests(std::uint32_t body, int axis) const {
        if (isStatic(body)) return false;
        return (bodies_.moving.anchors->rests[body] & axisBit(axis)) != 0;
    }

    void setRests(std::uint32_t row, int axis, bool rests) const {
        auto& column = bodies_.moving.anchors->rests;
        const std::uint8_t others = column[row] & static_cast<std::uint8_t>(~axisBit(axis));
        column.set(row, static_cast<std::uint8_t>(others | (rests ? axisBit(axis) : 0)));
    }

    /// Whether the body stays where it is along the axis, whatever rests on it.
    bool holds(std::uint32_t body, int axis) const { return isStatic(body) || rests(body, axis); }

    /// Until when `upper` stands over `lower`, which it touches along the axis; -never if it does
    /// not.
    double restsUntil(std::uint32_t upper, std::uint32_t lower, int axis, double now) const {
        const Path p = path(upper, axis);
        const Path q = path(lower, axis);
        const double reach = reachOf(upper, lower, axis);
        const double distance = q.position(now) - p.position(now);
        if (!(distance * gravity(axis) > 0)) return -never;
        if (std::abs(std::abs(distance) - reach) > rounding(p, q, reach, now)) return -never;
        const int across = 1 - axis;
        const Path r = path(upper, across);
        const Path s = path(lower, across);
        const double width = reachOf(upper, lower, across);
        return insideUntil(approach(r, s, width, rounding(r, s, width, now)), now);
    }

    /// Whether what meets at a speed of `closing`, pressed together by an acceleration, does not
    /// rise above the rounding of positions any more.
    static bool comesToRest(double closing, double pressure, double rounding, double restitution) {
        const double parting = closing > 0 ? restitution * closing : closing;
        return pressure > 0 && parting * parting <= 2 * pressure * rounding;
    }

  private:
    const BodyView<Real>& bodies_;
    const std::array<double, 2>& gravity_;
};

}  // namespace quadrille
