#include "collision/continuous/event_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/rules/contact_law.hpp"

namespace quadrille {

namespace {

/// With restitution below 1, bodies that would part slower than this do not part, and those that
/// approach slower than `creepSpeed` do not collide, px/s.
constexpr double restSpeed = 1e-6;
constexpr double creepSpeed = 1e-9;

}  // namespace

template <class Real, class Path>
bool EventLoop<Real, Path>::leavesPartition(std::uint32_t row, double now) const {
    const double left = window_.to - now;
    const auto leaves = [&](int axis, double start) {
        const Path p = motion_.path(row, axis);
        const double speed = std::abs(p.speed(now)) + std::abs(acceleration(p)) * left;
        return std::abs(p.position(now) - start) + speed * left >
               static_cast<double>(window_.reach);
    };
    return leaves(0, motion_.moving().x[row]) || leaves(1, motion_.moving().y[row]);
}

template <class Real, class Path>
void EventLoop<Real, Path>::set(std::uint32_t row, int axis, double anchor, double velocity,
                                double time) {
    motion_.set(row, axis, anchor, velocity, time);
    if constexpr (!falls) state_.fastest = std::max(state_.fastest, std::abs(velocity));
}

/// The body's trajectory is another one: what was found from the old one is void.
template <class Real, class Path>
void EventLoop<Real, Path>::changed(std::uint32_t row) {
    ++search_.stamp(row);
    state_.changed.push_back(row);
}

/// Whether a pair that overlaps deeply has had its collision of this instant: a body that is wedged
/// between two others would be sent to and fro for ever. With restitution below 1 it is not.
template <class Real, class Path>
bool EventLoop<Real, Path>::separatedAlready(const PairEvent& event) {
    auto& separated = state_.separated;
    if (event.time != state_.instant) {
        state_.instant = event.time;
        separated.clear();
    }
    const std::pair pair(event.a, event.b);
    if (std::find(separated.begin(), separated.end(), pair) != separated.end()) return true;
    separated.push_back(pair);
    return false;
}

/// Approaches slower than this are none: rounding leaves bodies that move together so. 0 where
/// restitution is 1, px/s.
template <class Real, class Path>
double EventLoop<Real, Path>::creep(double va, double vb) const {
    if (search_.restitution() == 1) return 0;
    constexpr double eps = 4 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    return std::max(creepSpeed, eps * (std::abs(va) + std::abs(vb)));
}

// ---- what an event does

/// Carries an event out. Returns whether any trajectory changed.
template <class Real, class Path>
bool EventLoop<Real, Path>::resolve(const PairEvent& event, ContactRecord& record) {
    const double now = event.time;
    if constexpr (falls) {
        if (event.release) {
            const int axis = event.axes == axisX ? 0 : 1;
            const bool first = release(event.a, axis, now);
            if (first) changed(event.a);
            const bool second = !event.withStatic() && release(event.b, axis, now);
            if (second) changed(event.b);
            return first || second;
        }
    }
    const auto distance = [&](int axis) {
        return motion_.path(event.b, axis).position(now) -
               motion_.path(event.a, axis).position(now);
    };
    const double dx = distance(0);
    const double dy = distance(1);
    std::uint8_t axes = event.axes;
    if (axes == 0) {
        const double reachX = motion_.reachOf(event.a, event.b, 0);
        const double reachY = motion_.reachOf(event.a, event.b, 1);
        const auto least = leastPenetration(dx, dy, reachX, reachY);
        axes = least.axis;
        const int axis = axes == axisX ? 0 : 1;
        const double slack =
            Motion::rounding(motion_.path(event.a, axis), motion_.path(event.b, axis),
                             axis == 0 ? reachX : reachY, now);
        if (search_.restitution() == 1 && least.depth > slack && separatedAlready(event))
            return false;
    }
    const int senseX = dx >= 0 ? 1 : -1;
    const int senseY = dy >= 0 ? 1 : -1;
    const auto along = [&](int axis, int sense) {
        return (axes & axisBit(axis)) != 0 ? collide(event, axis, sense) : Outcome::Nothing;
    };
    const Outcome alongX = along(0, senseX);
    const Outcome alongY = along(1, senseY);
    if (alongX == Outcome::Nothing && alongY == Outcome::Nothing) return false;
    changed(event.a);
    if (!event.withStatic()) changed(event.b);
    for (const std::uint32_t row : state_.groupChanged) {
        if (row != event.a && row != event.b) changed(row);
    }
    state_.groupChanged.clear();
    const auto b = static_cast<std::int64_t>(event.b & ~PairEvent::staticBit);
    record = {.time = now,
              .a = event.a,
              .b = event.withStatic() ? -1 - b : b,
              .axes = static_cast<std::uint8_t>((alongX == Outcome::Collision ? axisX : 0) |
                                                (alongY == Outcome::Collision ? axisY : 0)),
              .senseX = static_cast<std::int8_t>(senseX),
              .senseY = static_cast<std::int8_t>(senseY),
              .collided = true};
    return true;
}

/// Carries out one axis of an event.
template <class Real, class Path>
typename EventLoop<Real, Path>::Outcome EventLoop<Real, Path>::collide(const PairEvent& event,
                                                                       int axis, double sense) {
    const double now = event.time;
    const Path a = motion_.path(event.a, axis);
    const Path b = motion_.path(event.b, axis);
    const double va = a.speed(now);
    const double vb = b.speed(now);
    const double closing = (va - vb) * sense;
    if constexpr (falls) {
        const bool aOnB = motion_.gravity(axis) * sense > 0;
        const std::uint32_t upper = aOnB ? event.a : event.b;
        const std::uint32_t lower = aOnB ? event.b : event.a;
        const double pressure = (a.acceleration - b.acceleration) * sense;
        const double slack = Motion::rounding(a, b, motion_.reachOf(event.a, event.b, axis), now);
        if (motion_.holds(lower, axis) &&
            Motion::comesToRest(closing, pressure, slack, search_.restitution())) {
            const double down = aOnB ? sense : -sense;
            const double surface = surfaceFor(event, upper, lower, axis, down);
            motion_.setRests(upper, axis, true);
            set(upper, axis, surface, 0, now);
            return closing * closing > 2 * pressure * slack ? Outcome::Collision : Outcome::Touch;
        }
    }
    if (!(closing > creep(va, vb))) return Outcome::Nothing;
    if (search_.restitution() < 1) {
        collideGroups(event, axis, sense);
    } else if (event.withStatic()) {
        bounceOff(event, event.a, event.b, axis, sense);
    } else {
        exchange(event, axis, sense);
    }
    return search_.restitution() == 1 || closing >= restSpeed ? Outcome::Collision : Outcome::Touch;
}

/// Two bodies that are free to move collide elastically along an axis.
template <class Real, class Path>
void EventLoop<Real, Path>::exchange(const PairEvent& event, int axis, double sense) {
    const double now = event.time;
    const Path a = motion_.path(event.a, axis);
    const Path b = motion_.path(event.b, axis);
    const double massA = motion_.moving().mass[event.a];
    const double massB = motion_.moving().mass[event.b];
    if (massA == massB && event.axes != 0 && acceleration(a) == acceleration(b)) {
        const double shift = sense * motion_.reachOf(event.a, event.b, axis);
        set(event.a, axis, b.anchor - shift, b.velocity, b.time);
        set(event.b, axis, a.anchor + shift, a.velocity, a.time);
        return;
    }
    double va = a.speed(now);
    double vb = b.speed(now);
    exchangeImpulse(va, vb, massA, massB, 1.0);
    if constexpr (falls) {
        motion_.setRests(event.a, axis, false);
        motion_.setRests(event.b, axis, false);
    }
    set(event.a, axis, a.position(now), va, now);
    set(event.b, axis, b.position(now), vb, now);
}

/// A body rebounds from something that holds.
template <class Real, class Path>
void EventLoop<Real, Path>::bounceOff(const PairEvent& event, std::uint32_t row, std::uint32_t off,
                                      int axis, double sense) {
    const double now = event.time;
    const Path p = motion_.path(row, axis);
    const double surface = surfaceFor(event, row, off, axis, sense);
    if (event.axes != 0 && search_.restitution() == 1 && acceleration(p) == 0) {
        set(row, axis, 2 * surface - p.anchor, -p.velocity, p.time);
        return;
    }
    const double rebound = search_.restitution() * p.speed(now);
    const bool parts = search_.restitution() == 1 || std::abs(rebound) >= restSpeed;
    set(row, axis, surface, parts ? -rebound : 0, now);
}

/// Where a body stands that touches another; where it stands now if it is deep inside.
template <class Real, class Path>
double EventLoop<Real, Path>::surfaceFor(const PairEvent& event, std::uint32_t row,
                                         std::uint32_t other, int axis, double sense) const {
    const Path p = motion_.path(row, axis);
    const Path q = motion_.path(other, axis);
    const double at = p.position(event.time);
    const double reach = motion_.reachOf(row, other, axis);
    const double surface = q.position(event.time) - sense * reach;
    const bool deep =
        event.axes == 0 && std::abs(at - surface) > Motion::rounding(p, q, reach, event.time);
    return deep ? at : surface;
}

// ---- bodies that are pushed together

/// The bodies that `row` pushes along when it is pushed: those that it touches on that side and
/// that move with it, and so on. In order of their rows; `held` if something holds them.
template <class Real, class Path>
void EventLoop<Real, Path>::gather(std::uint32_t row, int axis, double sense, double now,
                                   Group& group) {
    const int across = 1 - axis;
    const double gravity = motion_.gravity(axis);
    const auto isHeld = [&](std::uint32_t body) {
        return Motion::isStatic(body) || (motion_.rests(body, axis) && gravity * sense > 0);
    };
    state_.gathered.resize(motion_.moving().size());
    state_.gathered[row] = ++state_.gathering;
    group.rows.assign(1, row);
    group.held = isHeld(row);
    for (std::size_t i = 0; i < group.rows.size() && !group.held; ++i) {
        const std::uint32_t a = group.rows[i];
        const Path p = motion_.path(a, axis);
        for (const std::uint32_t b : search_.neighbours()[a]) {
            const Path q = motion_.path(b, axis);
            const double reach = motion_.reachOf(a, b, axis);
            const double distance = (q.position(now) - p.position(now)) * sense;
            if (std::abs(distance - reach) > Motion::rounding(p, q, reach, now)) continue;
            const double va = p.speed(now);
            const double vb = q.speed(now);
            if (std::abs(va - vb) > creep(va, vb)) continue;
            const Path r = motion_.path(a, across);
            const Path s = motion_.path(b, across);
            const double width = motion_.reachOf(a, b, across);
            const double slack = Motion::rounding(r, s, width, now);
            if (!(insideUntil(approach(r, s, width, slack), now) > now)) continue;
            group.held = group.held || isHeld(b);
            if (Motion::isStatic(b) || state_.gathered[b] == state_.gathering) continue;
            state_.gathered[b] = state_.gathering;
            group.rows.push_back(b);
        }
    }
    std::sort(group.rows.begin(), group.rows.end());
    group.mass = 0;
    for (const std::uint32_t i : group.rows) group.mass += motion_.moving().mass[i];
}

template <class Real, class Path>
void EventLoop<Real, Path>::move(const Group& group, int axis, double velocity, double now) {
    for (const std::uint32_t row : group.rows) {
        const double at = motion_.path(row, axis).position(now);
        if constexpr (falls) motion_.setRests(row, axis, false);
        set(row, axis, at, velocity, now);
        state_.groupChanged.push_back(row);
    }
}

/// A collision with restitution below 1. Bodies that touch and move together act as one: what is
/// pushed pushes in turn, and all at once (Moreau's law of simultaneous impacts). One after the
/// other they would take a number of collisions without end to come to the same velocity.
template <class Real, class Path>
void EventLoop<Real, Path>::collideGroups(const PairEvent& event, int axis, double sense) {
    const double now = event.time;
    gather(event.a, axis, -sense, now, state_.groupA);
    if (event.withStatic()) {
        state_.groupB.held = true;
    } else {
        gather(event.b, axis, sense, now, state_.groupB);
    }
    double va = motion_.path(event.a, axis).speed(now);
    double vb = motion_.path(event.b, axis).speed(now);
    const bool parts = search_.restitution() * std::abs(va - vb) >= restSpeed;
    if (state_.groupA.held || state_.groupB.held) {
        // One of the two is held and stands; if both are, neither has anywhere to go.
        const double rebound = parts ? search_.restitution() * (vb - va) : 0;
        va = state_.groupA.held ? 0 : rebound;
        vb = state_.groupB.held ? 0 : -rebound;
    } else if (parts) {
        exchangeImpulse(va, vb, state_.groupA.mass, state_.groupB.mass, search_.restitution());
    } else {
        va = vb = va + state_.groupB.mass / (state_.groupA.mass + state_.groupB.mass) * (vb - va);
    }
    if (!state_.groupA.held) move(state_.groupA, axis, va, now);
    if (!state_.groupB.held) move(state_.groupB, axis, vb, now);
    if (state_.groupA.held && state_.groupB.held) {
        set(event.a, axis, motion_.path(event.a, axis).position(now), 0, now);
        if (!event.withStatic()) {
            set(event.b, axis, motion_.path(event.b, axis).position(now), 0, now);
        }
    }
}

// ---- bodies at rest

template <class Real, class Path>
bool EventLoop<Real, Path>::supported(std::uint32_t row, int axis, double now) const {
    for (const std::uint32_t b : search_.neighbours()[row]) {
        if (motion_.holds(b, axis) && motion_.restsUntil(row, b, axis, now) > now) return true;
    }
    return false;
}

/// Lets a body fall if nothing holds it any more.
template <class Real, class Path>
bool EventLoop<Real, Path>::release(std::uint32_t row, int axis, double now) {
    if (!motion_.rests(row, axis) || supported(row, axis, now)) return false;
    const double at = motion_.path(row, axis).position(now);
    motion_.setRests(row, axis, false);
    set(row, axis, at, 0, now);
    return true;
}

/// Lets fall bodies that have changed, and what rested on them, and what rested on that, unless
/// something holds them.
template <class Real, class Path>
void EventLoop<Real, Path>::releaseFromChanged(double now) {
    const ColumnView<std::uint8_t> resting = motion_.moving().anchors->rests.view();
    if (resting.uniform() && resting.common == 0) return;
    for (std::size_t i = 0; i < state_.changed.size(); ++i) {
        for (int axis = 0; axis < 2; ++axis) {
            if (release(state_.changed[i], axis, now)) changed(state_.changed[i]);
            if (motion_.rests(state_.changed[i], axis)) continue;
            for (const std::uint32_t b : search_.neighbours()[state_.changed[i]]) {
                if (!Motion::isStatic(b) && release(b, axis, now)) changed(b);
            }
        }
    }
}

template class EventLoop<double, StraightPath>;
template class EventLoop<double, FallingPath>;
template class EventLoop<float, StraightPath>;
template class EventLoop<float, FallingPath>;

}  // namespace quadrille
