#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include <quadrille/bodies.hpp>

#include "collision/continuous/event_queue.hpp"
#include "collision/continuous/trajectories.hpp"
#include "collision/pairs/cell_walk.hpp"
#include "collision/pairs/neighbours.hpp"

namespace quadrille {

/// Finds what happens next to pairs of bodies, for the law `continuous`. Every function pushes the
/// events that it finds to a queue.
template <class Real, class Path>
class EventSearch {
  public:
    using Motion = Trajectories<Real, Path>;
    using Paths = typename Motion::Paths;

    /// `stamps` count the changes of each moving body's trajectory; what is referred to must
    /// outlive this.
    EventSearch(const Motion& motion, const Neighbours& neighbours, std::span<std::uint32_t> stamps,
                double restitution)
        : motion_(motion), neighbours_(neighbours), stamps_(stamps), restitution_(restitution) {}

    const Motion& motion() const { return motion_; }
    const Neighbours& neighbours() const { return neighbours_; }
    double restitution() const { return restitution_; }

    /// Whether the trajectories are those that the event was found from.
    bool isCurrent(const PairEvent& event) const {
        return event.stampA == stamps_[event.a] &&
               (event.withStatic() || event.stampB == stamps_[event.b]);
    }
    std::uint32_t& stamp(std::uint32_t row) const { return stamps_[row]; }

    /// All meetings of candidates between `from`, when positions are up to date, and `to`.
    void findAmong(std::span<const MovingPair> pairs, double from, double to,
                   EventQueue& queue) const {
        const auto& m = motion_.moving();
        const Real h = static_cast<Real>(to - from);
        const auto near = [&](MovingPair p, int axis, std::span<const Real> position,
                              std::span<const Real> velocity, const ColumnView<Real>& half) {
            const Real u = velocity[p.b] - velocity[p.a];
            const Real reach = half[p.a] + half[p.b];
            const double room = slack(axis, std::abs(position[p.a]) + reach, u, h, to);
            return comesNear(position[p.b] - position[p.a], u, reach, h, static_cast<Real>(room));
        };
        for (const MovingPair p : pairs) {
            if (near(p, 0, m.x, m.vx, m.halfWidth) && near(p, 1, m.y, m.vy, m.halfHeight)) {
                find(p.a, motion_.paths(p.a), p.b, motion_.paths(p.b), from, to, false, queue);
            }
        }
    }
    void findAmong(std::span<const StaticPair> pairs, double from, double to,
                   EventQueue& queue) const {
        for (const StaticPair p : pairs) {
            const std::uint32_t b = p.fixed | PairEvent::staticBit;
            find(p.a, motion_.paths(p.a), b, motion_.paths(b), from, to, false, queue);
        }
    }

    /// What happens after an event at time `now` to a body that it changed and some of its
    /// neighbours, until `to`.
    void findFor(std::uint32_t row, std::span<const std::uint32_t> others, double now, double to,
                 EventQueue& queue) const {
        const Paths own = motion_.paths(row);
        const std::array<double, 2> at{own.along[0].position(now), own.along[1].position(now)};
        const std::array<double, 2> velocity{own.along[0].speed(now), own.along[1].speed(now)};
        const double h = to - now;
        for (const std::uint32_t b : others) {
            const Paths other = motion_.paths(b);
            const auto near = [&](int axis) {
                const auto k = static_cast<std::size_t>(axis);
                const double d = other.along[k].position(now) - at[k];
                const double u = other.along[k].speed(now) - velocity[k];
                const double reach = motion_.reachOf(row, b, axis);
                return comesNear(d, u, reach, h, slack(axis, std::abs(at[k]) + reach, u, h, to));
            };
            if (near(0) && near(1)) find(row, own, b, other, now, to, true, queue);
        }
    }

  private:
    static constexpr bool falls = Path::falls;

    /// Whether a distance d that changes by u a second comes within reach during a time h: takes no
    /// division, and is true for few.
    template <class Number>
    static bool comesNear(Number d, Number u, Number reach, Number h, Number slack) {
        const Number half = u * (h / 2);
        return std::abs(d + half) < reach + std::abs(half) + slack;
    }

    /// Room for gravity and for the rounding of positions and times in comesNear().
    double slack(int axis, double position, double u, double h, double to) const {
        constexpr double eps = 16 * static_cast<double>(std::numeric_limits<Real>::epsilon());
        constexpr double epsTime = 16 * std::numeric_limits<double>::epsilon();
        const double room = eps * position + std::abs(u) * (eps * h + epsTime * to);
        if constexpr (!falls) return room;
        return room + std::abs(motion_.gravity(axis)) * h * h;
    }

    /// An event of two bodies at a time, without axes.
    PairEvent eventOf(std::uint32_t row, std::uint32_t b, double time) const {
        const bool isStatic = Motion::isStatic(b);
        const bool inOrder = isStatic || row < b;
        const std::uint32_t first = inOrder ? row : b;
        const std::uint32_t second = inOrder ? b : row;
        return {.time = time,
                .a = first,
                .b = second,
                .stampA = stamps_[first],
                .stampB = isStatic ? 0 : stamps_[second],
                .axes = 0,
                .release = false};
    }

    /// What happens next to body `row`, whose paths are given, and another, from `from` on. After
    /// an event, at time `from`, a pair that overlaps or touches already is looked at there and
    /// then; it is asked only there, so that the answer does not depend on where steps begin.
    void find(std::uint32_t row, const Paths& own, std::uint32_t b, const Paths& other, double from,
              double to, bool afterEvent, EventQueue& queue) const {
        double slackX = 0;
        double slackY = 0;
        const double reachX = motion_.reachOf(row, b, 0);
        const double reachY = motion_.reachOf(row, b, 1);
        if constexpr (falls) {
            slackX = Motion::rounding(own.along[0], other.along[0], reachX, from);
            slackY = Motion::rounding(own.along[1], other.along[1], reachY, from);
            findRest(eventOf(row, b, from), to, afterEvent, queue);
        }
        const auto x = approach(own.along[0], other.along[0], reachX, slackX);
        if (!touches(x, from, to)) return;
        const auto y = approach(own.along[1], other.along[1], reachY, slackY);
        if (!touches(y, from, to)) return;
        const Meeting meeting = meet(x, y, from);
        if (meeting.time <= to) {
            PairEvent met = eventOf(row, b, meeting.time);
            met.axes = meeting.axes;
            queue.push(met);
        }
        if ((!afterEvent && !falls) || meeting.time == from) return;
        const double untilX = insideUntil(x, from);
        const double untilY = insideUntil(y, from);
        if (untilX > from && untilY > from) {
            findOverlap(eventOf(row, b, from), std::min(untilX, untilY), to, afterEvent, queue);
        }
    }

    /// A pair that overlaps, at the event's time, collides there and then if it approaches along
    /// its axis of least penetration; or, if gravity makes it turn inside, at the turn.
    void findOverlap(PairEvent event, double until, double to, bool afterEvent,
                     EventQueue& queue) const {
        const double from = event.time;
        const Paths a = motion_.paths(event.a);
        const Paths b = motion_.paths(event.b);
        const auto distance = [&](int axis) {
            return b.along[axis].position(from) - a.along[axis].position(from);
        };
        const auto least =
            leastPenetration(distance(0), distance(1), motion_.reachOf(event.a, event.b, 0),
                             motion_.reachOf(event.a, event.b, 1));
        const int axis = least.axis == axisX ? 0 : 1;
        const Path& p = a.along[axis];
        const Path& q = b.along[axis];
        const double closing = (p.speed(from) - q.speed(from)) * least.sense;
        if (afterEvent && closing > 0) {
            queue.push(event);
            return;
        }
        if constexpr (falls) {
            const double pressure = (p.acceleration - q.acceleration) * least.sense;
            if (!(pressure > 0)) return;
            const double t0 = std::max(p.time, q.time);
            event.time = t0 - (p.speed(t0) - q.speed(t0)) * least.sense / pressure;
            if (afterEvent && event.time < from) event.time = from;
            if (event.time < until && event.time <= to &&
                (event.time > from || (afterEvent && event.time == from))) {
                queue.push(event);
            }
        }
    }

    /// A pair that touches along gravity: the upper one comes to rest there and then, at the
    /// event's time, or slides off later.
    void findRest(PairEvent event, double to, bool afterEvent, EventQueue& queue) const {
        const double from = event.time;
        const Paths a = motion_.paths(event.a);
        const Paths b = motion_.paths(event.b);
        for (int axis = 0; axis < 2; ++axis) {
            const double gravity = motion_.gravity(axis);
            if (gravity == 0) continue;
            const Path& p = a.along[axis];
            const Path& q = b.along[axis];
            const double distance = q.position(from) - p.position(from);
            const double sense = distance >= 0 ? 1 : -1;
            const bool onTop = gravity * sense > 0;  // a on b
            const std::uint32_t upper = onTop ? event.a : event.b;
            const std::uint32_t lower = onTop ? event.b : event.a;
            if (Motion::isStatic(upper) || !motion_.holds(lower, axis)) continue;
            const double until = motion_.restsUntil(upper, lower, axis, from);
            if (!(until > from)) continue;
            event.axes = axisBit(axis);
            if (motion_.rests(upper, axis)) {
                event.time = until;
                event.release = true;
                if (until <= to) queue.push(event);
            } else if (afterEvent) {
                const double reach = motion_.reachOf(event.a, event.b, axis);
                const double closing = (p.speed(from) - q.speed(from)) * sense;
                event.time = from;
                event.release = false;
                const double slack = Motion::rounding(p, q, reach, from);
                if (Motion::comesToRest(closing, std::abs(gravity), slack, restitution_)) {
                    queue.push(event);
                }
            }
        }
    }

    const Motion& motion_;
    const Neighbours& neighbours_;
    std::span<std::uint32_t> stamps_;
    double restitution_;
};

}  // namespace quadrille
