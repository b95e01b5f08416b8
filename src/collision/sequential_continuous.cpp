#include "collision/sequential_continuous.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <quadrille/error.hpp>

#include "collision/canonical_order.hpp"

namespace quadrille {

namespace {

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

// ---- trajectories

template <class Real>
void SequentialContinuous<Real>::anchor(const BodyView<Real>& bodies, double now) {
    const auto& m = bodies.moving;
    auto& anchors = *m.anchors;
    stamps_.resize(m.size());
    if (!anchors.enabled) {
        anchors.start(m.x, m.y, now);
        // Overlaps are looked for where a run begins, and around each event after.
        changed_.resize(m.size());
        for (std::uint32_t i = 0; i < m.size(); ++i) changed_[i] = i;
    }
    if (anchors.missing == 0) return;
    for (std::uint32_t i = 0; i < m.size(); ++i) {
        if (!std::isnan(anchors.timeX[i])) continue;
        anchors.put(i, m.x[i], m.y[i], now);
        ++stamps_[i];
        changed_.push_back(i);
    }
    anchors.missing = 0;
}

template <class Real>
Trajectory SequentialContinuous<Real>::trajectory(const BodyView<Real>& bodies, std::uint32_t row,
                                                  int axis) const {
    const auto& m = bodies.moving;
    const auto& anchors = *m.anchors;
    if (axis == 0) return {anchors.x[row], m.vx[row], anchors.timeX[row]};
    return {anchors.y[row], m.vy[row], anchors.timeY[row]};
}

template <class Real>
Trajectory SequentialContinuous<Real>::other(const BodyView<Real>& bodies, std::uint32_t b,
                                             int axis) const {
    if ((b & staticBit) == 0) return trajectory(bodies, b, axis);
    const std::uint32_t k = b & ~staticBit;
    return {axis == 0 ? bodies.fixed.x[k] : bodies.fixed.y[k], 0, 0};
}

template <class Real>
typename SequentialContinuous<Real>::Paths SequentialContinuous<Real>::pathsOf(
    const BodyView<Real>& bodies, std::uint32_t row) const {
    return {trajectory(bodies, row, 0), trajectory(bodies, row, 1)};
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
    (axis == 0 ? m.vx : m.vy)[row] = static_cast<Real>(to.velocity);
}

template <class Real>
void SequentialContinuous<Real>::place(const BodyView<Real>& bodies, double t) const {
    const auto along = [t](std::span<Real> position, const std::vector<Real>& anchor,
                           std::span<const Real> velocity, const ColumnView<double>& times) {
        const auto at = [&](std::size_t i, double time) {
            return static_cast<Real>(static_cast<double>(anchor[i]) + velocity[i] * (t - time));
        };
        if (times.uniform()) {
            for (std::size_t i = 0; i < position.size(); ++i) position[i] = at(i, times.common);
        } else {
            for (std::size_t i = 0; i < position.size(); ++i) position[i] = at(i, times.values[i]);
        }
    };
    const auto& m = bodies.moving;
    const auto& anchors = *m.anchors;
    along(m.x, anchors.x, m.vx, anchors.timeX.view());
    along(m.y, anchors.y, m.vy, anchors.timeY.view());
}

template <class Real>
Real SequentialContinuous<Real>::reach(const BodyView<Real>& bodies, double from, double to) const {
    const auto& m = bodies.moving;
    Real fastest = 0;
    Real farthest = 0;
#pragma omp simd reduction(max : fastest, farthest)
    for (std::size_t i = 0; i < m.size(); ++i) {
        const Real vx = std::abs(m.vx[i]);
        const Real vy = std::abs(m.vy[i]);
        const Real speed = vx > vy ? vx : vy;
        fastest = speed > fastest ? speed : fastest;
        const Real x = std::abs(m.x[i]);
        const Real y = std::abs(m.y[i]);
        const Real distance = x > y ? x : y;
        farthest = distance > farthest ? distance : farthest;
    }
    // A light body leaves a heavy one at up to twice the heavy one's speed. The rest covers the
    // rounding of positions; without it a pair that only touches might be left out.
    const double gain = m.mass.uniform() ? 1 : 2;
    constexpr double eps = 8 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    return static_cast<Real>(gain * static_cast<double>(fastest) * (to - from) * (1 + 1e-6) +
                             eps * static_cast<double>(farthest));
}

template <class Real>
bool SequentialContinuous<Real>::leavesPartition(const BodyView<Real>& bodies, std::uint32_t row,
                                                 double now, double to) const {
    const auto leaves = [&](int axis, double start) {
        const Trajectory path = trajectory(bodies, row, axis);
        const double walked = std::abs(path.position(now) - start);
        return walked + std::abs(path.velocity) * (to - now) > static_cast<double>(reach_);
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

/// Brings the events up to the end of the step to the heap, which stays small that way.
template <class Real>
void SequentialContinuous<Real>::collectDue(double to) {
    stepEnd_ = to;
    std::size_t kept = 0;
    for (const Event& event : future_) {
        if (event.time > to) {
            future_[kept++] = event;
        } else {
            heap_.push_back(event);
        }
    }
    future_.resize(kept);
    std::make_heap(heap_.begin(), heap_.end(), Later());
}

template <class Real>
void SequentialContinuous<Real>::push(const BodyView<Real>& bodies, double time, std::uint32_t a,
                                      std::uint32_t b, std::uint8_t axes) {
    const bool isStatic = (b & staticBit) != 0;
    if (!isStatic && b < a) std::swap(a, b);
    const std::uint32_t entityB =
        isStatic ? bodies.fixed.entity[b & ~staticBit] : bodies.moving.entity[b];
    const Event event{.time = time,
                      .priority = pairPriority(bodies.moving.entity[a], entityB),
                      .a = a,
                      .b = b,
                      .stampA = stamps_[a],
                      .stampB = isStatic ? 0 : stamps_[b],
                      .axes = axes};
    if (time > stepEnd_) {
        future_.push_back(event);
        return;
    }
    heap_.push_back(event);
    std::push_heap(heap_.begin(), heap_.end(), Later());
}

/// Finds the next meeting of body `row`, whose paths are given, with another. After an event, at
/// time `from`, a pair that overlaps already meets there and then; it is asked only there, so that
/// the answer does not depend on where steps begin.
template <class Real>
void SequentialContinuous<Real>::find(const BodyView<Real>& bodies, std::uint32_t row,
                                      const Paths& paths, std::uint32_t b, double from, double to,
                                      bool afterEvent) {
    const Interval x = approach(paths.x, other(bodies, b, 0), reachOf(bodies, row, b, 0));
    if (!touches(x, from, to)) return;
    const Interval y = approach(paths.y, other(bodies, b, 1), reachOf(bodies, row, b, 1));
    if (!touches(y, from, to)) return;
    const Meeting meeting = meet(x, y, from);
    if (meeting.time <= to) {
        push(bodies, meeting.time, row, b, meeting.axes);
    } else if (afterEvent && overlapAt(x, y, from)) {
        push(bodies, from, row, b, 0);
    }
}

template <class Real>
void SequentialContinuous<Real>::findFor(const BodyView<Real>& bodies, std::uint32_t row,
                                         double now, double to) {
    const Paths paths = pathsOf(bodies, row);
    for (const std::uint32_t b : neighbours(row)) find(bodies, row, paths, b, now, to, true);
}

/// All meetings of candidates between `from` and `to`.
template <class Real>
void SequentialContinuous<Real>::findAll(const BodyView<Real>& bodies, double from, double to) {
    for (const MovingPair p : candidates_.moving()) {
        if (approaching(bodies, p, static_cast<Real>(to - from))) {
            find(bodies, p.a, pathsOf(bodies, p.a), p.b, from, to, false);
        }
    }
    for (const StaticPair p : candidates_.fixed()) {
        find(bodies, p.a, pathsOf(bodies, p.a), p.fixed | staticBit, from, to, false);
    }
}

/// Whether two bodies that go straight on for a time h, from where they stand, come to overlap,
/// with room for rounding: cheap, and true for few.
template <class Real>
bool SequentialContinuous<Real>::approaching(const BodyView<Real>& bodies, MovingPair p,
                                             Real h) const {
    constexpr Real eps = 16 * std::numeric_limits<Real>::epsilon();
    const auto along = [&](std::span<const Real> position, std::span<const Real> velocity,
                           const ColumnView<Real>& half) {
        const Real u = (velocity[p.b] - velocity[p.a]) * (h / 2);
        const Real d = position[p.b] - position[p.a] + u;
        const Real slack = eps * (std::abs(position[p.a]) + half[p.a] + std::abs(u));
        return std::abs(d) < half[p.a] + half[p.b] + std::abs(u) + slack;
    };
    const auto& m = bodies.moving;
    return along(m.x, m.vx, m.halfWidth) && along(m.y, m.vy, m.halfHeight);
}

// ---- events

template <class Real>
bool SequentialContinuous<Real>::isCurrent(const Event& event) const {
    return event.stampA == stamps_[event.a] &&
           ((event.b & staticBit) != 0 || event.stampB == stamps_[event.b]);
}

/// Whether an overlapping pair has had its collision of this instant. A body that is wedged between
/// two others would be sent to and fro for ever.
template <class Real>
bool SequentialContinuous<Real>::separatedAlready(const Event& event) {
    if (event.time != instant_) {
        instant_ = event.time;
        separated_.clear();
    }
    const std::pair pair(event.a, event.b);
    if (std::find(separated_.begin(), separated_.end(), pair) != separated_.end()) return true;
    separated_.push_back(pair);
    return false;
}

template <class Real>
bool SequentialContinuous<Real>::collideMoving(const BodyView<Real>& bodies, const Event& event,
                                               int axis, double sense) {
    const Trajectory a = trajectory(bodies, event.a, axis);
    const Trajectory b = trajectory(bodies, event.b, axis);
    if (!((a.velocity - b.velocity) * sense > 0)) return false;
    const double massA = bodies.moving.mass[event.a];
    const double massB = bodies.moving.mass[event.b];
    if (massA == massB && event.axes != 0) {
        const double shift = sense * reachOf(bodies, event.a, event.b, axis);
        set(bodies, event.a, axis, {b.anchor - shift, b.velocity, b.time});
        set(bodies, event.b, axis, {a.anchor + shift, a.velocity, a.time});
        return true;
    }
    double va = a.velocity;
    double vb = b.velocity;
    exchangeImpulse(va, vb, massA, massB, 1.0);
    set(bodies, event.a, axis, {a.position(event.time), va, event.time});
    set(bodies, event.b, axis, {b.position(event.time), vb, event.time});
    return true;
}

template <class Real>
bool SequentialContinuous<Real>::collideStatic(const BodyView<Real>& bodies, const Event& event,
                                               int axis, double sense) {
    const Trajectory a = trajectory(bodies, event.a, axis);
    if (!(a.velocity * sense > 0)) return false;
    if (event.axes == 0) {
        // Already inside: it turns back where it is.
        set(bodies, event.a, axis, {a.position(event.time), -a.velocity, event.time});
        return true;
    }
    const double surface =
        other(bodies, event.b, axis).anchor - sense * reachOf(bodies, event.a, event.b, axis);
    set(bodies, event.a, axis, {2 * surface - a.anchor, -a.velocity, a.time});
    return true;
}

template <class Real>
bool SequentialContinuous<Real>::collide(const BodyView<Real>& bodies, const Event& event, int axis,
                                         double sense) {
    return (event.b & staticBit) != 0 ? collideStatic(bodies, event, axis, sense)
                                      : collideMoving(bodies, event, axis, sense);
}

/// Carries an event out. Returns the axes along which the bodies collided.
template <class Real>
std::uint8_t SequentialContinuous<Real>::resolve(const BodyView<Real>& bodies, const Event& event,
                                                 ContactRecord& record) {
    const double dx = other(bodies, event.b, 0).position(event.time) -
                      trajectory(bodies, event.a, 0).position(event.time);
    const double dy = other(bodies, event.b, 1).position(event.time) -
                      trajectory(bodies, event.a, 1).position(event.time);
    std::uint8_t axes = event.axes;
    if (axes == 0) {
        if (separatedAlready(event)) return 0;
        axes = leastPenetration(dx, dy, reachOf(bodies, event.a, event.b, 0),
                                reachOf(bodies, event.a, event.b, 1))
                   .axis;
    }
    const int senseX = dx >= 0 ? 1 : -1;
    const int senseY = dy >= 0 ? 1 : -1;
    std::uint8_t hit = 0;
    if ((axes & axisX) != 0 && collide(bodies, event, 0, senseX)) hit |= axisX;
    if ((axes & axisY) != 0 && collide(bodies, event, 1, senseY)) hit |= axisY;
    const auto b = static_cast<std::int64_t>(event.b & ~staticBit);
    record = {.time = event.time,
              .a = event.a,
              .b = (event.b & staticBit) != 0 ? -1 - b : b,
              .axes = hit,
              .senseX = static_cast<std::int8_t>(senseX),
              .senseY = static_cast<std::int8_t>(senseY),
              .collided = true};
    return hit;
}

template <class Real>
double SequentialContinuous<Real>::advance(const BodyView<Real>& bodies,
                                           const Partition<Real>& partition, Real reach,
                                           double from, double to,
                                           std::vector<ContactRecord>* records,
                                           ResolveCounts& counts) {
    reach_ = reach;
    collectDue(to);
    const bool newPairs = candidates_.update(bodies, partition);
    if (newPairs) linkNeighbours(bodies);
    if (newPairs || to > horizon_) {
        // Meetings do not depend on steps, so they are found for as long as the pairs may last.
        const double life =
            reach > 0 ? std::max(1.0, static_cast<double>(partition.margin / reach)) : 1.0;
        horizon_ = std::max(to, from + life * (to - from));
        findAll(bodies, from, horizon_);
        counts.pairsTested += candidates_.size();
    }
    for (const std::uint32_t row : changed_) findFor(bodies, row, from, horizon_);
    changed_.clear();

    const std::uint64_t most = counts.contacts + mostEventsPerBody * (bodies.moving.size() + 1);
    while (!heap_.empty()) {
        const Event event = heap_.front();
        std::pop_heap(heap_.begin(), heap_.end(), Later());
        heap_.pop_back();
        if (!isCurrent(event)) continue;
        if (++counts.contacts > most) {
            throw Error("the law 'continuous' found more than " +
                        std::to_string(mostEventsPerBody) + " events per body in a step");
        }
        ContactRecord record;
        if (resolve(bodies, event, record) == 0) continue;
        ++counts.collisions;
        if (records != nullptr) records->push_back(record);
        ++stamps_[event.a];
        changed_.push_back(event.a);
        if ((event.b & staticBit) == 0) {
            ++stamps_[event.b];
            changed_.push_back(event.b);
        }
        for (const std::uint32_t row : changed_) {
            // The caller makes a partition that covers the new speed, and the search goes on there.
            if (leavesPartition(bodies, row, event.time, to)) return event.time;
        }
        for (const std::uint32_t row : changed_) findFor(bodies, row, event.time, horizon_);
        changed_.clear();
    }
    return to;
}

template <class Real>
std::size_t SequentialContinuous<Real>::bytes() const {
    return candidates_.bytes() + (heap_.capacity() + future_.capacity()) * sizeof(Event) +
           (neighbourStarts_.capacity() + neighbours_.capacity() + stamps_.capacity() +
            changed_.capacity() + 2 * separated_.capacity()) *
               sizeof(std::uint32_t);
}

template class SequentialContinuous<double>;
template class SequentialContinuous<float>;

}  // namespace quadrille
