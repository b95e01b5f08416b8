#include "collision/sequential_continuous.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <quadrille/error.hpp>

#include "collision/canonical_order.hpp"
#include "collision/hit_bits.hpp"

namespace quadrille {

namespace {

constexpr std::uint8_t axisBit(int axis) { return axis == 0 ? axisX : axisY; }

/// A body rests on a surface when its rebound would rise by less than this share of its half size.
constexpr double restHeight = 1e-6;

/// Two boxes touch if their distance differs from their reach by less than this share of it.
constexpr double touchTolerance = 1e-9;

/// Far more events per body and step than any scene has; a loop without progress ends here.
constexpr std::uint64_t mostEventsPerBody = 100'000;

}  // namespace

/// The top of the heap is the earliest event; ties go by the hash of the pair, then the rows.
template <class Real>
struct SequentialContinuous<Real>::Later {
    bool operator()(const Event& p, const Event& q) const {
        if (p.time != q.time) return p.time > q.time;
        if (p.priority != q.priority) return p.priority > q.priority;
        if (p.a != q.a) return p.a > q.a;
        return p.b > q.b;
    }
};

template <class Real>
SequentialContinuous<Real>::SequentialContinuous(const Vec2& gravity, double restitution)
    : gravity_{gravity.x(), gravity.y()}, restitution_(restitution) {}

// ---- trajectories

template <class Real>
void SequentialContinuous<Real>::anchor(const BodyView<Real>& bodies, double now) {
    auto& anchors = *bodies.moving.anchors;
    const auto& m = bodies.moving;
    const bool accelerated = gravity_[0] != 0 || gravity_[1] != 0;
    if (!anchors.enabled || (accelerated && !anchors.accelerated)) {
        anchors.start(m.x, m.y, m.vx, m.vy, now, accelerated);
        anchors.missing = 0;
        changed_.resize(m.size());
        for (std::uint32_t i = 0; i < m.size(); ++i) changed_[i] = i;
    } else if (anchors.missing > 0) {
        for (std::uint32_t i = 0; i < m.size(); ++i) {
            if (!std::isnan(anchors.timeX[i])) continue;
            anchors.put(i, m.x[i], m.y[i], m.vx[i], m.vy[i], now);
            changed_.push_back(i);
        }
        anchors.missing = 0;
    }
    stamps_.resize(m.size());
}

template <class Real>
Trajectory SequentialContinuous<Real>::trajectory(const BodyView<Real>& bodies, std::uint32_t row,
                                                  int axis) const {
    const auto& m = bodies.moving;
    const auto& anchors = *m.anchors;
    const double velocity =
        anchors.accelerated ? (axis == 0 ? anchors.vx : anchors.vy)[row] : (axis == 0 ? m.vx : m.vy)[row];
    return {.anchor = (axis == 0 ? anchors.x : anchors.y)[row],
            .velocity = velocity,
            .time = (axis == 0 ? anchors.timeX : anchors.timeY)[row],
            .acceleration =
                resting(bodies, row, axis) ? 0.0 : gravity_[static_cast<std::size_t>(axis)]};
}

template <class Real>
Trajectory SequentialContinuous<Real>::other(const BodyView<Real>& bodies, std::uint32_t b,
                                             int axis) const {
    if ((b & staticBit) == 0) return trajectory(bodies, b, axis);
    const std::uint32_t k = b & ~staticBit;
    return {.anchor = (axis == 0 ? bodies.fixed.x : bodies.fixed.y)[k],
            .velocity = 0,
            .time = -never,
            .acceleration = 0};
}

template <class Real>
double SequentialContinuous<Real>::reachOf(const BodyView<Real>& bodies, std::uint32_t a,
                                           std::uint32_t b, int axis) const {
    const auto& own = axis == 0 ? bodies.moving.halfWidth : bodies.moving.halfHeight;
    const auto& fixed = axis == 0 ? bodies.fixed.halfWidth : bodies.fixed.halfHeight;
    const double half = (b & staticBit) != 0 ? fixed[b & ~staticBit] : own[b];
    return static_cast<double>(own[a]) + half;
}

template <class Real>
void SequentialContinuous<Real>::set(const BodyView<Real>& bodies, std::uint32_t row, int axis,
                                     const Trajectory& to) {
    const auto& m = bodies.moving;
    auto& anchors = *m.anchors;
    (axis == 0 ? anchors.x : anchors.y)[row] = static_cast<Real>(to.anchor);
    (axis == 0 ? anchors.timeX : anchors.timeY).set(row, to.time);
    const auto velocity = static_cast<Real>(to.velocity);
    if (anchors.accelerated) {
        (axis == 0 ? anchors.vx : anchors.vy)[row] = velocity;
    } else {
        (axis == 0 ? m.vx : m.vy)[row] = velocity;
    }
}

template <class Real>
bool SequentialContinuous<Real>::resting(const BodyView<Real>& bodies, std::uint32_t row,
                                         int axis) const {
    return (bodies.moving.anchors->resting[row] & axisBit(axis)) != 0;
}

template <class Real>
void SequentialContinuous<Real>::setResting(const BodyView<Real>& bodies, std::uint32_t row,
                                            int axis, bool rests) {
    auto& flags = bodies.moving.anchors->resting;
    const auto bit = axisBit(axis);
    flags.set(row, static_cast<std::uint8_t>(rests ? flags[row] | bit : flags[row] & ~bit));
}

template <class Real>
void SequentialContinuous<Real>::place(const BodyView<Real>& bodies, double t) const {
    const auto& m = bodies.moving;
    const auto& anchors = *m.anchors;
    if (!anchors.accelerated) {
        const auto along = [&](std::span<Real> position, const std::vector<Real>& anchor,
                               std::span<const Real> velocity, const ColumnView<double>& times) {
            Real* const p = position.data();
            if (times.uniform()) {
                const double s = t - times.common;
                for (std::size_t i = 0; i < position.size(); ++i) {
                    p[i] = static_cast<Real>(static_cast<double>(anchor[i]) + velocity[i] * s);
                }
            } else {
                for (std::size_t i = 0; i < position.size(); ++i) {
                    p[i] = static_cast<Real>(static_cast<double>(anchor[i]) +
                                             velocity[i] * (t - times.values[i]));
                }
            }
        };
        along(m.x, anchors.x, m.vx, anchors.timeX.view());
        along(m.y, anchors.y, m.vy, anchors.timeY.view());
        return;
    }
    for (std::uint32_t i = 0; i < m.size(); ++i) {
        const Trajectory x = trajectory(bodies, i, 0);
        const Trajectory y = trajectory(bodies, i, 1);
        m.x[i] = static_cast<Real>(x.position(t));
        m.y[i] = static_cast<Real>(y.position(t));
        m.vx[i] = static_cast<Real>(x.speed(t));
        m.vy[i] = static_cast<Real>(y.speed(t));
    }
}

template <class Real>
Real SequentialContinuous<Real>::reach(const BodyView<Real>& bodies, double from, double to) const {
    const auto& m = bodies.moving;
    Real fastest = 0;
#pragma omp simd reduction(max : fastest)
    for (std::size_t i = 0; i < m.size(); ++i) {
        const Real x = std::abs(m.vx[i]);
        const Real y = std::abs(m.vy[i]);
        const Real speed = x > y ? x : y;
        fastest = speed > fastest ? speed : fastest;
    }
    const double h = to - from;
    const double fall = std::max(std::abs(gravity_[0]), std::abs(gravity_[1])) * h;
    // A light body leaves a heavy one at up to twice the heavy one's speed.
    const double gain = m.mass.uniform() ? 1.0 : 2.0;
    // The share covers rounding; without it a body that only touches might be left out.
    return static_cast<Real>((gain * (static_cast<double>(fastest) + fall)) * h * (1 + 1e-6) +
                             1e-6 * static_cast<double>(m.size() > 0 ? m.halfWidth[0] : 0));
}

template <class Real>
bool SequentialContinuous<Real>::leavesPartition(const BodyView<Real>& bodies, std::uint32_t row,
                                                 double now, double to) const {
    const double h = to - now;
    const auto leaves = [&](int axis, double start) {
        const Trajectory path = trajectory(bodies, row, axis);
        const double walked = std::abs(path.position(now) - start);
        return walked + (std::abs(path.speed(now)) + std::abs(path.acceleration) * h) * h >
               static_cast<double>(reach_);
    };
    return leaves(0, bodies.moving.x[row]) || leaves(1, bodies.moving.y[row]);
}

// ---- finding events

template <class Real>
void SequentialContinuous<Real>::linkNeighbours(const BodyView<Real>& bodies) {
    const std::size_t rows = bodies.moving.size();
    neighbourStarts_.assign(rows + 1, 0);
    for (const MovingPair p : candidates_.moving()) {
        ++neighbourStarts_[p.a];
        ++neighbourStarts_[p.b];
    }
    for (const StaticPair p : candidates_.fixed()) ++neighbourStarts_[p.a];
    std::uint32_t end = 0;
    for (std::size_t i = 0; i < rows; ++i) neighbourStarts_[i] = end += neighbourStarts_[i];
    neighbourStarts_[rows] = end;
    neighbours_.resize(end);
    for (const MovingPair p : candidates_.moving()) {
        neighbours_[--neighbourStarts_[p.a]] = p.b;
        neighbours_[--neighbourStarts_[p.b]] = p.a;
    }
    for (const StaticPair p : candidates_.fixed()) {
        neighbours_[--neighbourStarts_[p.a]] = p.fixed | staticBit;
    }
}

template <class Real>
std::span<const std::uint32_t> SequentialContinuous<Real>::neighbours(std::uint32_t row) const {
    return {neighbours_.data() + neighbourStarts_[row],
            neighbours_.data() + neighbourStarts_[row + 1]};
}

template <class Real>
void SequentialContinuous<Real>::push(const BodyView<Real>& bodies, double time, std::uint32_t a,
                                      std::uint32_t b, std::uint8_t axes, Kind kind) {
    const bool isStatic = (b & staticBit) != 0;
    const std::uint32_t entityB =
        isStatic ? bodies.fixed.entity[b & ~staticBit] : bodies.moving.entity[b];
    heap_.push_back({.time = time,
                     .priority = pairPriority(bodies.moving.entity[a], entityB),
                     .a = a,
                     .b = b,
                     .stampA = stamps_[a],
                     .stampB = isStatic ? 0 : stamps_[b],
                     .axes = axes,
                     .kind = kind});
    std::push_heap(heap_.begin(), heap_.end(), Later());
}

/// Finds the next meeting of a pair. After an event of one of them, at time `from`, a pair that
/// overlaps already meets there and then; it is asked only there, so that the answer does not
/// depend on where steps begin.
template <class Real>
void SequentialContinuous<Real>::find(const BodyView<Real>& bodies, std::uint32_t a, std::uint32_t b,
                                      double from, double to, bool afterEvent) {
    if ((b & staticBit) == 0 && b < a) std::swap(a, b);
    const Intervals x =
        approach(trajectory(bodies, a, 0), other(bodies, b, 0), reachOf(bodies, a, b, 0));
    if (x.count == 0) return;
    const Intervals y =
        approach(trajectory(bodies, a, 1), other(bodies, b, 1), reachOf(bodies, a, b, 1));
    const Meeting meeting = meet(x, y, from);
    if (meeting.time <= to) push(bodies, meeting.time, a, b, meeting.axes, Kind::Meeting);
    if (afterEvent && meeting.time > from && overlapAt(x, y, from)) {
        push(bodies, from, a, b, 0, Kind::Meeting);
    }
}

template <class Real>
void SequentialContinuous<Real>::findFor(const BodyView<Real>& bodies, std::uint32_t row, double now,
                                         double to) {
    for (const std::uint32_t neighbour : neighbours(row)) {
        find(bodies, row, neighbour, now, to, true);
    }
    if (bodies.moving.anchors->resting[row] != 0) findRelease(bodies, row, now, to);
}

/// When a resting body slides off the first of its supports.
template <class Real>
void SequentialContinuous<Real>::findRelease(const BodyView<Real>& bodies, std::uint32_t row,
                                             double now, double to) {
    for (int axis = 0; axis < 2; ++axis) {
        if (!resting(bodies, row, axis)) continue;
        const int across = 1 - axis;
        for (const std::uint32_t b : neighbours(row)) {
            const double reach = reachOf(bodies, row, b, axis);
            const double gap =
                std::abs(other(bodies, b, axis).position(now) -
                         trajectory(bodies, row, axis).position(now)) - reach;
            if (std::abs(gap) > touchTolerance * reach) continue;
            const Intervals beside = approach(trajectory(bodies, row, across),
                                              other(bodies, b, across),
                                              reachOf(bodies, row, b, across));
            for (int i = 0; i < beside.count; ++i) {
                if (beside.leave[i] > now && beside.leave[i] <= to) {
                    push(bodies, beside.leave[i], row, b, axisBit(axis), Kind::Release);
                }
            }
        }
    }
}

/// All meetings between `from` and `to`. Most candidates stay apart: a test on the straight paths,
/// with room for gravity and rounding, leaves those whose times are worth computing.
template <class Real>
void SequentialContinuous<Real>::findAll(const BodyView<Real>& bodies, double from, double to) {
    const auto& m = bodies.moving;
    const Real* const x = m.x.data();
    const Real* const y = m.y.data();
    const Real* const vx = m.vx.data();
    const Real* const vy = m.vy.data();
    const double h = to - from;
    const Real half = static_cast<Real>(h / 2);
    const Real fallX = static_cast<Real>(std::abs(gravity_[0]) * h * h);
    const Real fallY = static_cast<Real>(std::abs(gravity_[1]) * h * h);
    constexpr Real eps = 16 * std::numeric_limits<Real>::epsilon();
    withSizes(bodies, [&](const auto& sizes) {
        const auto mayMeet = [&](MovingPair p) {
            const Real ux = (vx[p.b] - vx[p.a]) * half;
            const Real uy = (vy[p.b] - vy[p.a]) * half;
            const Real dx = x[p.b] - x[p.a] + ux;
            const Real dy = y[p.b] - y[p.a] + uy;
            const Real slackX = fallX + eps * (std::abs(x[p.a]) + std::abs(ux));
            const Real slackY = fallY + eps * (std::abs(y[p.a]) + std::abs(uy));
            const Real reachX = (sizes.width(p.a) + sizes.width(p.b)) * (1 + eps);
            const Real reachY = (sizes.height(p.a) + sizes.height(p.b)) * (1 + eps);
            return overlaps(dx, dy, reachX + std::abs(ux) + slackX, reachY + std::abs(uy) + slackY);
        };
        const auto pairs = candidates_.moving();
        const MovingPair* pair = pairs.data();
        const MovingPair* const end = pair + pairs.size();
        const auto visit = [&](MovingPair p) { find(bodies, p.a, p.b, from, to, false); };
        for (; end - pair >= static_cast<std::ptrdiff_t>(hitBlock<Real>); pair += hitBlock<Real>) {
            forEachBit(hitBits<Real>([&](std::size_t l) { return mayMeet(pair[l]); }),
                       [&](std::size_t l) { visit(pair[l]); });
        }
        for (; pair != end; ++pair) {
            if (mayMeet(*pair)) visit(*pair);
        }
    });
    for (const StaticPair p : candidates_.fixed()) {
        find(bodies, p.a, p.fixed | staticBit, from, to, false);
    }
    const auto resting = m.anchors->resting.view();
    if (resting.uniform() && resting.common == 0) return;
    for (std::uint32_t i = 0; i < m.size(); ++i) {
        if (resting[i] != 0) findRelease(bodies, i, from, to);
    }
}

// ---- resting bodies

template <class Real>
double SequentialContinuous<Real>::restSpeed(const BodyView<Real>& bodies, std::uint32_t row,
                                             int axis) const {
    if (restitution_ == 1) return 0;
    const auto& half = axis == 0 ? bodies.moving.halfWidth : bodies.moving.halfHeight;
    return std::sqrt(2 * std::abs(gravity_[static_cast<std::size_t>(axis)]) * restHeight *
                     static_cast<double>(half[row]));
}

/// Whether something that does not move along the axis holds the body against gravity.
template <class Real>
bool SequentialContinuous<Real>::supported(const BodyView<Real>& bodies, std::uint32_t row, int axis,
                                           double now) const {
    const int across = 1 - axis;
    const double down = gravity_[static_cast<std::size_t>(axis)];
    const Trajectory own = trajectory(bodies, row, axis);
    for (const std::uint32_t b : neighbours(row)) {
        if ((b & staticBit) == 0 && !resting(bodies, b, axis)) continue;
        const double reach = reachOf(bodies, row, b, axis);
        const double distance = other(bodies, b, axis).position(now) - own.position(now);
        if (distance * down <= 0) continue;
        if (std::abs(std::abs(distance) - reach) > touchTolerance * reach) continue;
        const Intervals beside = approach(trajectory(bodies, row, across), other(bodies, b, across),
                                          reachOf(bodies, row, b, across));
        for (int i = 0; i < beside.count; ++i) {
            if (beside.enter[i] <= now && now < beside.leave[i]) return true;
        }
    }
    return false;
}

/// Gravity acts on the body again.
template <class Real>
void SequentialContinuous<Real>::wake(const BodyView<Real>& bodies, std::uint32_t row, int axis,
                                      double now) {
    const Trajectory path = trajectory(bodies, row, axis);
    setResting(bodies, row, axis, false);
    set(bodies, row, axis, {path.position(now), path.speed(now), now, 0});
    ++stamps_[row];
    changed_.push_back(row);
    wakeRestingOn(bodies, row, axis, now);
}

/// Wakes the bodies that may have rested on one whose motion changed.
template <class Real>
void SequentialContinuous<Real>::wakeRestingOn(const BodyView<Real>& bodies, std::uint32_t row,
                                               int axis, double now) {
    const auto resting = bodies.moving.anchors->resting.view();
    if (resting.uniform() && resting.common == 0) return;
    for (const std::uint32_t b : neighbours(row)) {
        if ((b & staticBit) != 0 || !this->resting(bodies, b, axis)) continue;
        if (!supported(bodies, b, axis, now)) wake(bodies, b, axis, now);
    }
}

// ---- events

template <class Real>
bool SequentialContinuous<Real>::collideMoving(const BodyView<Real>& bodies, const Event& event,
                                               int axis, double sense) {
    const double now = event.time;
    const double reach = reachOf(bodies, event.a, event.b, axis);
    const Trajectory a = trajectory(bodies, event.a, axis);
    const Trajectory b = trajectory(bodies, event.b, axis);
    double va = a.speed(now);
    double vb = b.speed(now);
    const double closing = (va - vb) * sense;
    // A body that gravity presses onto a resting one without speed is at rest too.
    const double pressing = (a.acceleration - b.acceleration) * sense;
    if (!(closing > 0) && !(closing == 0 && pressing > 0)) return false;

    const bool restingA = resting(bodies, event.a, axis);
    const bool restingB = resting(bodies, event.b, axis);
    const auto land = [&](std::uint32_t row, const Trajectory& on, double side) {
        setResting(bodies, row, axis, true);
        set(bodies, row, axis, {on.position(now) + side * reach, 0, now, 0});
    };
    if (restingB && !restingA && a.acceleration * sense > 0 &&
        restitution_ * closing <= restSpeed(bodies, event.a, axis)) {
        land(event.a, b, -sense);
        return closing > 0;
    }
    if (restingA && !restingB && b.acceleration * sense < 0 &&
        restitution_ * closing <= restSpeed(bodies, event.b, axis)) {
        land(event.b, a, sense);
        return closing > 0;
    }
    const double massA = bodies.moving.mass[event.a];
    const double massB = bodies.moving.mass[event.b];
    if (massA == massB && restitution_ == 1 && !restingA && !restingB) {
        set(bodies, event.a, axis, {b.anchor - sense * reach, b.velocity, b.time, 0});
        set(bodies, event.b, axis, {a.anchor + sense * reach, a.velocity, a.time, 0});
        return true;
    }
    exchangeImpulse(va, vb, massA, massB, restitution_);
    setResting(bodies, event.a, axis, false);
    setResting(bodies, event.b, axis, false);
    set(bodies, event.a, axis, {a.position(now), va, now, 0});
    set(bodies, event.b, axis, {b.position(now), vb, now, 0});
    return true;
}

template <class Real>
bool SequentialContinuous<Real>::collideStatic(const BodyView<Real>& bodies, const Event& event,
                                               int axis, double sense) {
    const double now = event.time;
    const Trajectory a = trajectory(bodies, event.a, axis);
    const double v = a.speed(now);
    const bool pressing = a.acceleration * sense > 0;
    if (!(v * sense > 0) && !(v == 0 && pressing)) return false;
    const double surface =
        other(bodies, event.b, axis).anchor - sense * reachOf(bodies, event.a, event.b, axis);
    if (a.acceleration == 0 && restitution_ == 1) {
        set(bodies, event.a, axis, {2 * surface - a.anchor, -a.velocity, a.time, 0});
        return true;
    }
    const double rebound = -restitution_ * v;
    const bool rests = pressing && std::abs(rebound) <= restSpeed(bodies, event.a, axis);
    setResting(bodies, event.a, axis, rests);
    set(bodies, event.a, axis, {surface, rests ? 0 : rebound, now, 0});
    return v != 0;
}

template <class Real>
bool SequentialContinuous<Real>::collide(const BodyView<Real>& bodies, const Event& event, int axis,
                                         int sense) {
    const bool collided = (event.b & staticBit) != 0
                              ? collideStatic(bodies, event, axis, sense)
                              : collideMoving(bodies, event, axis, sense);
    return collided;
}

template <class Real>
double SequentialContinuous<Real>::advance(const BodyView<Real>& bodies,
                                           const Partition<Real>& partition, Real reach,
                                           double from, double to,
                                           std::vector<ContactRecord>* records,
                                           ResolveCounts& counts) {
    reach_ = reach;
    if (candidates_.update(bodies, partition)) linkNeighbours(bodies);
    counts.pairsTested += candidates_.size();
    findAll(bodies, from, to);
    for (const std::uint32_t row : changed_) findFor(bodies, row, from, to);
    changed_.clear();

    const std::uint64_t most = counts.contacts + mostEventsPerBody * (bodies.moving.size() + 1);
    while (!heap_.empty() && heap_.front().time <= to) {
        const Event event = heap_.front();
        std::pop_heap(heap_.begin(), heap_.end(), Later());
        heap_.pop_back();
        const bool isStatic = (event.b & staticBit) != 0;
        if (event.stampA != stamps_[event.a] || (!isStatic && event.stampB != stamps_[event.b])) {
            continue;
        }
        const double now = event.time;
        if (event.kind == Kind::Release) {
            const int axis = event.axes == axisX ? 0 : 1;
            if (resting(bodies, event.a, axis) && !supported(bodies, event.a, axis, now)) {
                wake(bodies, event.a, axis, now);
            }
        } else {
            const double dx = other(bodies, event.b, 0).position(now) -
                              trajectory(bodies, event.a, 0).position(now);
            const double dy = other(bodies, event.b, 1).position(now) -
                              trajectory(bodies, event.a, 1).position(now);
            std::uint8_t axes = event.axes;
            if (axes == 0) {
                axes = leastPenetration(dx, dy, reachOf(bodies, event.a, event.b, 0),
                                        reachOf(bodies, event.a, event.b, 1))
                           .axis;
            }
            const int senseX = dx >= 0 ? 1 : -1;
            const int senseY = dy >= 0 ? 1 : -1;
            const auto restingBefore = bodies.moving.anchors->resting[event.a];
            std::uint8_t hit = 0;
            if ((axes & axisX) != 0 && collide(bodies, event, 0, senseX)) hit |= axisX;
            if ((axes & axisY) != 0 && collide(bodies, event, 1, senseY)) hit |= axisY;
            ++counts.contacts;
            if (hit == 0 && restingBefore == bodies.moving.anchors->resting[event.a]) continue;
            ++stamps_[event.a];
            changed_.push_back(event.a);
            if (!isStatic) {
                ++stamps_[event.b];
                changed_.push_back(event.b);
            }
            for (int axis = 0; axis < 2; ++axis) {
                if ((axes & axisBit(axis)) == 0) continue;
                wakeRestingOn(bodies, event.a, axis, now);
                if (!isStatic) wakeRestingOn(bodies, event.b, axis, now);
            }
            counts.collisions += hit != 0;
            if (records != nullptr && hit != 0) {
                const auto b = static_cast<std::int64_t>(event.b & ~staticBit);
                records->push_back({.time = now,
                                    .a = event.a,
                                    .b = isStatic ? -1 - b : b,
                                    .axes = hit,
                                    .senseX = static_cast<std::int8_t>(senseX),
                                    .senseY = static_cast<std::int8_t>(senseY),
                                    .collided = true});
            }
            if (counts.contacts > most) {
                throw Error("the law 'continuous' found more than " +
                            std::to_string(mostEventsPerBody) + " events per body in a step");
            }
        }
        for (const std::uint32_t row : changed_) {
            // The caller makes a partition that covers the new speed, and the search goes on there.
            if (leavesPartition(bodies, row, now, to)) return now;
        }
        for (const std::uint32_t row : changed_) findFor(bodies, row, now, to);
        changed_.clear();
    }
    heap_.clear();
    return to;
}

template <class Real>
std::size_t SequentialContinuous<Real>::bytes() const {
    return candidates_.bytes() + heap_.capacity() * sizeof(Event) +
           (neighbourStarts_.capacity() + neighbours_.capacity() + stamps_.capacity() +
            changed_.capacity()) *
               sizeof(std::uint32_t);
}

template class SequentialContinuous<double>;
template class SequentialContinuous<float>;

}  // namespace quadrille
