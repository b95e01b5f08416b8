#include "collision/sequential_continuous.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include <quadrille/error.hpp>

namespace quadrille {

namespace {

constexpr std::uint32_t staticBit = PairEvent::staticBit;

/// Far more events per body and step than any scene has; a loop without progress ends here.
constexpr std::uint64_t mostEventsPerBody = 100'000;

/// With restitution below 1, bodies that would part slower than this do not part, and those that
/// approach slower than `creepSpeed` do not collide, px/s.
constexpr double restSpeed = 1e-6;
constexpr double creepSpeed = 1e-9;

constexpr std::uint8_t axisBit(int axis) { return axis == 0 ? axisX : axisY; }

/// Whether a distance d that changes by u a second comes within reach during a time h: takes no
/// division, and is true for few.
template <class Real>
bool comesNear(Real d, Real u, Real reach, Real h, Real slack) {
    const Real half = u * (h / 2);
    return std::abs(d + half) < reach + std::abs(half) + slack;
}

double acceleration(const StraightPath&) { return 0; }
double acceleration(const FallingPath& path) { return path.acceleration; }

}  // namespace

// ---- trajectories

template <class Real, class Path>
void SequentialContinuous<Real, Path>::anchor(const BodyView<Real>& bodies, double now) {
    const auto& m = bodies.moving;
    auto& anchors = *m.anchors;
    const auto rows = static_cast<std::uint32_t>(m.size());
    const bool begins = !anchors.enabled;
    if (begins) {
        anchors = {};
        anchors.enabled = true;
        for (std::uint32_t i = 0; i < rows; ++i) anchors.append();
    }
    // Rows may have moved, sizes changed: what is known is found again. Where a run begins or was
    // edited, overlaps are looked for as well, and around each event after; where it is resumed,
    // not, so that it goes on as if it had not been interrupted.
    const bool edited = revision_.has_value() && *revision_ != bodies.revision;
    if (revision_ != bodies.revision) {
        revision_ = bodies.revision;
        events_.clear();
        horizon_ = -1;
        surveyed_ = false;
        stamps_.assign(rows, 0);
        if constexpr (!falls) anchors.rests = {};
        while (anchors.rests.size() < rows) anchors.rests.push_back(0);
    }
    if (anchors.incomplete) {
        for (std::uint32_t i = 0; i < rows; ++i) {
            if (!std::isnan(anchors.rows[i].timeX)) continue;
            anchors.rows[i] = {m.x[i], m.y[i], m.vx[i], m.vy[i], now, now};
            if (!edited) changed_.push_back(i);
        }
        anchors.incomplete = false;
    }
    if (edited) {
        changed_.resize(rows);
        for (std::uint32_t i = 0; i < rows; ++i) changed_[i] = i;
    }
}

template <class Real, class Path>
inline Path SequentialContinuous<Real, Path>::path(const BodyView<Real>& bodies, std::uint32_t body,
                                                   int axis) const {
    Path result{};
    if ((body & staticBit) != 0) {
        const std::uint32_t k = body & ~staticBit;
        result.anchor = axis == 0 ? bodies.fixed.x[k] : bodies.fixed.y[k];
        return result;
    }
    const Anchor<Real>& from = bodies.moving.anchors->rows[body];
    result.anchor = axis == 0 ? from.x : from.y;
    result.velocity = axis == 0 ? from.vx : from.vy;
    result.time = axis == 0 ? from.timeX : from.timeY;
    if constexpr (falls) {
        const double gravity = gravity_[static_cast<std::size_t>(axis)];
        result.acceleration = rests(bodies, body, axis) ? 0 : gravity;
    }
    return result;
}

template <class Real, class Path>
inline typename SequentialContinuous<Real, Path>::Paths SequentialContinuous<Real, Path>::paths(
    const BodyView<Real>& bodies, std::uint32_t body) const {
    return {{path(bodies, body, 0), path(bodies, body, 1)}};
}

template <class Real, class Path>
double SequentialContinuous<Real, Path>::reachOf(const BodyView<Real>& bodies, std::uint32_t a,
                                                 std::uint32_t b, int axis) const {
    const auto& own = axis == 0 ? bodies.moving.halfWidth : bodies.moving.halfHeight;
    const auto& fixed = axis == 0 ? bodies.fixed.halfWidth : bodies.fixed.halfHeight;
    const double half = (b & staticBit) != 0 ? fixed[b & ~staticBit] : own[b];
    return static_cast<double>(own[a]) + half;
}

template <class Real, class Path>
void SequentialContinuous<Real, Path>::set(const BodyView<Real>& bodies, std::uint32_t row,
                                           int axis, double anchor, double velocity, double time) {
    const auto& m = bodies.moving;
    Anchor<Real>& to = m.anchors->rows[row];
    (axis == 0 ? to.x : to.y) = static_cast<Real>(anchor);
    (axis == 0 ? to.vx : to.vy) = static_cast<Real>(velocity);
    (axis == 0 ? to.timeX : to.timeY) = time;
    if constexpr (!falls) {
        (axis == 0 ? m.vx : m.vy)[row] = static_cast<Real>(velocity);
        fastest_ = std::max(fastest_, std::abs(velocity));
    }
}

template <class Real, class Path>
bool SequentialContinuous<Real, Path>::place(const BodyView<Real>& bodies, double t) const {
    const auto& m = bodies.moving;
    const Anchor<Real>* const rows = m.anchors->rows.data();
    constexpr Real largest = std::numeric_limits<Real>::max();
    int lost = 0;
    for (std::uint32_t i = 0; i < m.size(); ++i) {
        if constexpr (falls) {
            const Paths at = paths(bodies, i);
            m.x[i] = static_cast<Real>(at.along[0].position(t));
            m.y[i] = static_cast<Real>(at.along[1].position(t));
            m.vx[i] = static_cast<Real>(at.along[0].speed(t));
            m.vy[i] = static_cast<Real>(at.along[1].speed(t));
        } else {
            const Anchor<Real>& a = rows[i];
            m.x[i] = static_cast<Real>(static_cast<double>(a.x) + a.vx * (t - a.timeX));
            m.y[i] = static_cast<Real>(static_cast<double>(a.y) + a.vy * (t - a.timeY));
        }
        lost |= !(std::abs(m.x[i]) <= largest) | !(std::abs(m.y[i]) <= largest);
    }
    return lost == 0;
}

/// Looks at the speeds and positions of all bodies, at a time when they are up to date.
template <class Real, class Path>
void SequentialContinuous<Real, Path>::survey(const BodyView<Real>& bodies) {
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
    fastest_ = static_cast<double>(fastest);
    farthest_ = static_cast<double>(farthest);
    surveyed_ = true;
}

template <class Real, class Path>
Real SequentialContinuous<Real, Path>::reach(const BodyView<Real>& bodies, double from, double to) {
    // Without gravity only events change speeds, and they keep count of the fastest.
    if (falls || !surveyed_) survey(bodies);
    const double gained =
        falls ? std::max(std::abs(gravity_[0]), std::abs(gravity_[1])) * (to - from) : 0;
    // A light body leaves a heavy one at up to twice the heavy one's speed. The rest covers the
    // rounding of positions; without it a pair that only touches might be left out.
    const double gain = bodies.moving.mass.uniform() ? 1 : 2;
    constexpr double eps = 8 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    const double way = gain * (fastest_ + gained) * (to - from);
    farthest_ += way;
    return static_cast<Real>(way * (1 + 1e-6) + eps * farthest_);
}

template <class Real, class Path>
bool SequentialContinuous<Real, Path>::leavesPartition(const BodyView<Real>& bodies,
                                                       std::uint32_t row, double now,
                                                       double to) const {
    const auto leaves = [&](int axis, double start) {
        const Path p = path(bodies, row, axis);
        const double speed = std::abs(p.speed(now)) + std::abs(acceleration(p)) * (to - now);
        return std::abs(p.position(now) - start) + speed * (to - now) > static_cast<double>(reach_);
    };
    return leaves(0, bodies.moving.x[row]) || leaves(1, bodies.moving.y[row]);
}

// ---- finding events

/// Finds what happens next to body `row`, whose paths are given, and another, from `from` on. After
/// an event, at time `from`, a pair that overlaps or touches already is looked at there and then;
/// it is asked only there, so that the answer does not depend on where steps begin.
template <class Real, class Path>
void SequentialContinuous<Real, Path>::find(const BodyView<Real>& bodies, std::uint32_t row,
                                            const Paths& own, std::uint32_t b, const Paths& other,
                                            double from, double to, bool afterEvent) {
    const auto event = [&] {
        const bool isStatic = (b & staticBit) != 0;
        const bool inOrder = isStatic || row < b;
        const std::uint32_t first = inOrder ? row : b;
        const std::uint32_t second = inOrder ? b : row;
        return PairEvent{.time = from,
                         .a = first,
                         .b = second,
                         .stampA = stamps_[first],
                         .stampB = isStatic ? 0 : stamps_[second],
                         .axes = 0,
                         .release = false};
    };
    double slackX = 0;
    double slackY = 0;
    const double reachX = reachOf(bodies, row, b, 0);
    const double reachY = reachOf(bodies, row, b, 1);
    if constexpr (falls) {
        slackX = rounding(own.along[0], other.along[0], reachX, from);
        slackY = rounding(own.along[1], other.along[1], reachY, from);
        findRest(bodies, event(), from, to, afterEvent);
    }
    const auto x = approach(own.along[0], other.along[0], reachX, slackX);
    if (!touches(x, from, to)) return;
    const auto y = approach(own.along[1], other.along[1], reachY, slackY);
    if (!touches(y, from, to)) return;
    const Meeting meeting = meet(x, y, from);
    if (meeting.time <= to) {
        PairEvent met = event();
        met.time = meeting.time;
        met.axes = meeting.axes;
        events_.push(met);
    }
    if ((!afterEvent && !falls) || meeting.time == from) return;
    const double untilX = insideUntil(x, from);
    const double untilY = insideUntil(y, from);
    if (untilX > from && untilY > from) {
        findOverlap(bodies, event(), std::min(untilX, untilY), from, to, afterEvent);
    }
}

/// A pair that overlaps collides there and then if it approaches along its axis of least
/// penetration; or, if gravity makes it turn inside, at the turn.
template <class Real, class Path>
void SequentialContinuous<Real, Path>::findOverlap(const BodyView<Real>& bodies, PairEvent event,
                                                   double until, double from, double to,
                                                   bool afterEvent) {
    const Paths a = paths(bodies, event.a);
    const Paths b = paths(bodies, event.b);
    const auto distance = [&](int axis) {
        return b.along[axis].position(from) - a.along[axis].position(from);
    };
    const auto least =
        leastPenetration(distance(0), distance(1), reachOf(bodies, event.a, event.b, 0),
                         reachOf(bodies, event.a, event.b, 1));
    const int axis = least.axis == axisX ? 0 : 1;
    const Path& p = a.along[axis];
    const Path& q = b.along[axis];
    const double closing = (p.speed(from) - q.speed(from)) * least.sense;
    if (afterEvent && closing > 0) {
        events_.push(event);
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
            events_.push(event);
        }
    }
}

template <class Real, class Path>
void SequentialContinuous<Real, Path>::findFor(const BodyView<Real>& bodies, std::uint32_t row,
                                               double now, double to) {
    const Paths own = paths(bodies, row);
    const std::array<double, 2> at{own.along[0].position(now), own.along[1].position(now)};
    const std::array<double, 2> velocity{own.along[0].speed(now), own.along[1].speed(now)};
    const double h = to - now;
    for (const std::uint32_t b : neighbours_[row]) {
        const Paths other = paths(bodies, b);
        const auto near = [&](int axis) {
            const auto k = static_cast<std::size_t>(axis);
            const double d = other.along[k].position(now) - at[k];
            const double u = other.along[k].speed(now) - velocity[k];
            const double reach = reachOf(bodies, row, b, axis);
            return comesNear(d, u, reach, h, slack(axis, std::abs(at[k]) + reach, u, h, to));
        };
        if (near(0) && near(1)) find(bodies, row, own, b, other, now, to, true);
    }
}

/// Room for gravity and for the rounding of positions and times in comesNear().
template <class Real, class Path>
double SequentialContinuous<Real, Path>::slack(int axis, double position, double u, double h,
                                               double to) const {
    constexpr double eps = 16 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    constexpr double epsTime = 16 * std::numeric_limits<double>::epsilon();
    const double room = eps * position + std::abs(u) * (eps * h + epsTime * to);
    if constexpr (!falls) return room;
    return room + std::abs(gravity_[static_cast<std::size_t>(axis)]) * h * h;
}

/// All meetings of candidates between `from` and `to`.
template <class Real, class Path>
void SequentialContinuous<Real, Path>::findAll(const BodyView<Real>& bodies, double from,
                                               double to) {
    const auto& m = bodies.moving;
    const Real h = static_cast<Real>(to - from);
    const auto near = [&](MovingPair p, int axis, std::span<const Real> position,
                          std::span<const Real> velocity, const ColumnView<Real>& half) {
        const Real u = velocity[p.b] - velocity[p.a];
        const Real reach = half[p.a] + half[p.b];
        const double room = slack(axis, std::abs(position[p.a]) + reach, u, h, to);
        return comesNear(position[p.b] - position[p.a], u, reach, h, static_cast<Real>(room));
    };
    for (const MovingPair p : candidates_.moving()) {
        if (near(p, 0, m.x, m.vx, m.halfWidth) && near(p, 1, m.y, m.vy, m.halfHeight)) {
            find(bodies, p.a, paths(bodies, p.a), p.b, paths(bodies, p.b), from, to, false);
        }
    }
    for (const StaticPair p : candidates_.fixed()) {
        const std::uint32_t b = p.fixed | staticBit;
        find(bodies, p.a, paths(bodies, p.a), b, paths(bodies, b), from, to, false);
    }
}

// ---- bodies at rest

template <class Real, class Path>
bool SequentialContinuous<Real, Path>::rests(const BodyView<Real>& bodies, std::uint32_t body,
                                             int axis) const {
    if ((body & staticBit) != 0) return false;
    return (bodies.moving.anchors->rests[body] & axisBit(axis)) != 0;
}

template <class Real, class Path>
void SequentialContinuous<Real, Path>::setRests(const BodyView<Real>& bodies, std::uint32_t row,
                                                int axis, bool rests) {
    auto& column = bodies.moving.anchors->rests;
    const std::uint8_t others = column[row] & static_cast<std::uint8_t>(~axisBit(axis));
    column.set(row, static_cast<std::uint8_t>(others | (rests ? axisBit(axis) : 0)));
}

/// Whether the body stays where it is along the axis, whatever rests on it.
template <class Real, class Path>
bool SequentialContinuous<Real, Path>::holds(const BodyView<Real>& bodies, std::uint32_t body,
                                             int axis) const {
    return (body & staticBit) != 0 || rests(bodies, body, axis);
}

/// A distance that may come from the rounding of positions and of times, px.
template <class Real, class Path>
double SequentialContinuous<Real, Path>::rounding(const Path& a, const Path& b, double reach,
                                                  double now) const {
    constexpr double eps = 8 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    constexpr double epsTime = 8 * std::numeric_limits<double>::epsilon();
    return eps * (std::abs(a.position(now)) + std::abs(b.position(now)) + reach) +
           epsTime * std::abs(now) * (std::abs(a.speed(now)) + std::abs(b.speed(now)));
}

/// Whether what meets at a speed of `closing`, pressed together by an acceleration, does not rise
/// above the rounding of positions any more.
template <class Real, class Path>
bool SequentialContinuous<Real, Path>::comesToRest(double closing, double pressure,
                                                   double rounding) const {
    const double parting = closing > 0 ? restitution_ * closing : closing;
    return pressure > 0 && parting * parting <= 2 * pressure * rounding;
}

/// A pair that touches along gravity: the upper one comes to rest there and then, or slides off
/// later.
template <class Real, class Path>
void SequentialContinuous<Real, Path>::findRest(const BodyView<Real>& bodies, PairEvent event,
                                                double from, double to, bool afterEvent) {
    const Paths a = paths(bodies, event.a);
    const Paths b = paths(bodies, event.b);
    for (int axis = 0; axis < 2; ++axis) {
        const double gravity = gravity_[static_cast<std::size_t>(axis)];
        if (gravity == 0) continue;
        const Path& p = a.along[axis];
        const Path& q = b.along[axis];
        const double distance = q.position(from) - p.position(from);
        const double sense = distance >= 0 ? 1 : -1;
        const bool onTop = gravity * sense > 0;  // a on b
        const std::uint32_t upper = onTop ? event.a : event.b;
        const std::uint32_t lower = onTop ? event.b : event.a;
        if ((upper & staticBit) != 0 || !holds(bodies, lower, axis)) continue;
        const double until = restsUntil(bodies, upper, lower, axis, from);
        if (!(until > from)) continue;
        event.axes = axisBit(axis);
        if (rests(bodies, upper, axis)) {
            event.time = until;
            event.release = true;
            if (until <= to) events_.push(event);
        } else if (afterEvent) {
            const double reach = reachOf(bodies, event.a, event.b, axis);
            const double closing = (p.speed(from) - q.speed(from)) * sense;
            event.time = from;
            event.release = false;
            if (comesToRest(closing, std::abs(gravity), rounding(p, q, reach, from))) {
                events_.push(event);
            }
        }
    }
}

/// Until when `upper` stands over `lower`, which it touches along the axis; -never if it does not.
template <class Real, class Path>
double SequentialContinuous<Real, Path>::restsUntil(const BodyView<Real>& bodies,
                                                    std::uint32_t upper, std::uint32_t lower,
                                                    int axis, double now) const {
    const Path p = path(bodies, upper, axis);
    const Path q = path(bodies, lower, axis);
    const double reach = reachOf(bodies, upper, lower, axis);
    const double distance = q.position(now) - p.position(now);
    if (!(distance * gravity_[static_cast<std::size_t>(axis)] > 0)) return -never;
    if (std::abs(std::abs(distance) - reach) > rounding(p, q, reach, now)) return -never;
    const int across = 1 - axis;
    const Path r = path(bodies, upper, across);
    const Path s = path(bodies, lower, across);
    const double width = reachOf(bodies, upper, lower, across);
    return insideUntil(approach(r, s, width, rounding(r, s, width, now)), now);
}

template <class Real, class Path>
bool SequentialContinuous<Real, Path>::supported(const BodyView<Real>& bodies, std::uint32_t row,
                                                 int axis, double now) const {
    for (const std::uint32_t b : neighbours_[row]) {
        if (holds(bodies, b, axis) && restsUntil(bodies, row, b, axis, now) > now) return true;
    }
    return false;
}

/// Lets a body fall if nothing holds it any more.
template <class Real, class Path>
bool SequentialContinuous<Real, Path>::release(const BodyView<Real>& bodies, std::uint32_t row,
                                               int axis, double now) {
    if (!rests(bodies, row, axis) || supported(bodies, row, axis, now)) return false;
    const double at = path(bodies, row, axis).position(now);
    setRests(bodies, row, axis, false);
    set(bodies, row, axis, at, 0, now);
    return true;
}

/// Lets fall bodies that have changed, and what rested on them, and what rested on that, unless
/// something holds them.
template <class Real, class Path>
void SequentialContinuous<Real, Path>::releaseFromChanged(const BodyView<Real>& bodies,
                                                          double now) {
    const ColumnView<std::uint8_t> resting = bodies.moving.anchors->rests.view();
    if (resting.uniform() && resting.common == 0) return;
    for (std::size_t i = 0; i < changed_.size(); ++i) {
        for (int axis = 0; axis < 2; ++axis) {
            if (release(bodies, changed_[i], axis, now)) changed(changed_[i]);
            if (rests(bodies, changed_[i], axis)) continue;
            for (const std::uint32_t b : neighbours_[changed_[i]]) {
                if ((b & staticBit) == 0 && release(bodies, b, axis, now)) changed(b);
            }
        }
    }
}

// ---- carrying events out

template <class Real, class Path>
bool SequentialContinuous<Real, Path>::isCurrent(const PairEvent& event) const {
    return event.stampA == stamps_[event.a] &&
           (event.withStatic() || event.stampB == stamps_[event.b]);
}

/// The body's trajectory is another one: what was found from the old one is void.
template <class Real, class Path>
void SequentialContinuous<Real, Path>::changed(std::uint32_t row) {
    ++stamps_[row];
    changed_.push_back(row);
}

/// Whether a pair that overlaps deeply has had its collision of this instant: a body that is wedged
/// between two others would be sent to and fro for ever. With restitution below 1 it is not.
template <class Real, class Path>
bool SequentialContinuous<Real, Path>::separatedAlready(const PairEvent& event) {
    if (event.time != instant_) {
        instant_ = event.time;
        separated_.clear();
    }
    const std::pair pair(event.a, event.b);
    if (std::find(separated_.begin(), separated_.end(), pair) != separated_.end()) return true;
    separated_.push_back(pair);
    return false;
}

/// Approaches slower than this are none: rounding leaves bodies that move together so. 0 where
/// restitution is 1, px/s.
template <class Real, class Path>
double SequentialContinuous<Real, Path>::creep(double va, double vb) const {
    if (restitution_ == 1) return 0;
    constexpr double eps = 4 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    return std::max(creepSpeed, eps * (std::abs(va) + std::abs(vb)));
}

/// Two bodies that are free to move collide elastically along an axis.
template <class Real, class Path>
void SequentialContinuous<Real, Path>::exchange(const BodyView<Real>& bodies,
                                                const PairEvent& event, int axis, double sense) {
    const double now = event.time;
    const Path a = path(bodies, event.a, axis);
    const Path b = path(bodies, event.b, axis);
    const double massA = bodies.moving.mass[event.a];
    const double massB = bodies.moving.mass[event.b];
    if (massA == massB && event.axes != 0 && acceleration(a) == acceleration(b)) {
        const double shift = sense * reachOf(bodies, event.a, event.b, axis);
        set(bodies, event.a, axis, b.anchor - shift, b.velocity, b.time);
        set(bodies, event.b, axis, a.anchor + shift, a.velocity, a.time);
        return;
    }
    double va = a.speed(now);
    double vb = b.speed(now);
    exchangeImpulse(va, vb, massA, massB, 1.0);
    if constexpr (falls) {
        setRests(bodies, event.a, axis, false);
        setRests(bodies, event.b, axis, false);
    }
    set(bodies, event.a, axis, a.position(now), va, now);
    set(bodies, event.b, axis, b.position(now), vb, now);
}

/// A body rebounds from something that holds.
template <class Real, class Path>
void SequentialContinuous<Real, Path>::bounceOff(const BodyView<Real>& bodies,
                                                 const PairEvent& event, std::uint32_t row,
                                                 std::uint32_t off, int axis, double sense) {
    const double now = event.time;
    const Path p = path(bodies, row, axis);
    const double surface = surfaceFor(bodies, event, row, off, axis, sense);
    if (event.axes != 0 && restitution_ == 1 && acceleration(p) == 0) {
        set(bodies, row, axis, 2 * surface - p.anchor, -p.velocity, p.time);
        return;
    }
    const double rebound = restitution_ * p.speed(now);
    const bool parts = restitution_ == 1 || std::abs(rebound) >= restSpeed;
    set(bodies, row, axis, surface, parts ? -rebound : 0, now);
}

/// Where a body stands that touches another; where it stands now if it is deep inside.
template <class Real, class Path>
double SequentialContinuous<Real, Path>::surfaceFor(const BodyView<Real>& bodies,
                                                    const PairEvent& event, std::uint32_t row,
                                                    std::uint32_t other, int axis,
                                                    double sense) const {
    const Path p = path(bodies, row, axis);
    const Path q = path(bodies, other, axis);
    const double at = p.position(event.time);
    const double reach = reachOf(bodies, row, other, axis);
    const double surface = q.position(event.time) - sense * reach;
    const bool deep = event.axes == 0 && std::abs(at - surface) > rounding(p, q, reach, event.time);
    return deep ? at : surface;
}

/// The bodies that `row` pushes along when it is pushed: those that it touches on that side and
/// that move with it, and so on. In order of their rows; `held` if something holds them.
template <class Real, class Path>
void SequentialContinuous<Real, Path>::gather(const BodyView<Real>& bodies, std::uint32_t row,
                                              int axis, double sense, double now, Group& group) {
    const int across = 1 - axis;
    const double gravity = gravity_[static_cast<std::size_t>(axis)];
    const auto isHeld = [&](std::uint32_t body) {
        return (body & staticBit) != 0 || (rests(bodies, body, axis) && gravity * sense > 0);
    };
    gathered_.resize(bodies.moving.size());
    gathered_[row] = ++gathering_;
    group.rows.assign(1, row);
    group.held = isHeld(row);
    for (std::size_t i = 0; i < group.rows.size() && !group.held; ++i) {
        const std::uint32_t a = group.rows[i];
        const Path p = path(bodies, a, axis);
        for (const std::uint32_t b : neighbours_[a]) {
            const Path q = path(bodies, b, axis);
            const double reach = reachOf(bodies, a, b, axis);
            const double distance = (q.position(now) - p.position(now)) * sense;
            if (std::abs(distance - reach) > rounding(p, q, reach, now)) continue;
            const double va = p.speed(now);
            const double vb = q.speed(now);
            if (std::abs(va - vb) > creep(va, vb)) continue;
            const Path r = path(bodies, a, across);
            const Path s = path(bodies, b, across);
            const double width = reachOf(bodies, a, b, across);
            const double slack = rounding(r, s, width, now);
            if (!(insideUntil(approach(r, s, width, slack), now) > now)) continue;
            group.held = group.held || isHeld(b);
            if ((b & staticBit) != 0 || gathered_[b] == gathering_) continue;
            gathered_[b] = gathering_;
            group.rows.push_back(b);
        }
    }
    std::sort(group.rows.begin(), group.rows.end());
    group.mass = 0;
    for (const std::uint32_t i : group.rows) group.mass += bodies.moving.mass[i];
}

template <class Real, class Path>
void SequentialContinuous<Real, Path>::move(const BodyView<Real>& bodies, const Group& group,
                                            int axis, double velocity, double now) {
    for (const std::uint32_t row : group.rows) {
        const double at = path(bodies, row, axis).position(now);
        if constexpr (falls) setRests(bodies, row, axis, false);
        set(bodies, row, axis, at, velocity, now);
        groupChanged_.push_back(row);
    }
}

/// A collision with restitution below 1. Bodies that touch and move together act as one: what is
/// pushed pushes in turn, and all at once (Moreau's law of simultaneous impacts). One after the
/// other they would take a number of collisions without end to come to the same velocity.
template <class Real, class Path>
void SequentialContinuous<Real, Path>::collideGroups(const BodyView<Real>& bodies,
                                                     const PairEvent& event, int axis,
                                                     double sense) {
    const double now = event.time;
    gather(bodies, event.a, axis, -sense, now, groupA_);
    if (event.withStatic()) {
        groupB_.held = true;
    } else {
        gather(bodies, event.b, axis, sense, now, groupB_);
    }
    double va = path(bodies, event.a, axis).speed(now);
    double vb = path(bodies, event.b, axis).speed(now);
    const bool parts = restitution_ * std::abs(va - vb) >= restSpeed;
    if (groupA_.held || groupB_.held) {
        // One of the two is held and stands; if both are, neither has anywhere to go.
        const double rebound = parts ? restitution_ * (vb - va) : 0;
        va = groupA_.held ? 0 : rebound;
        vb = groupB_.held ? 0 : -rebound;
    } else if (parts) {
        exchangeImpulse(va, vb, groupA_.mass, groupB_.mass, restitution_);
    } else {
        va = vb = va + groupB_.mass / (groupA_.mass + groupB_.mass) * (vb - va);
    }
    if (!groupA_.held) move(bodies, groupA_, axis, va, now);
    if (!groupB_.held) move(bodies, groupB_, axis, vb, now);
    if (groupA_.held && groupB_.held) {
        set(bodies, event.a, axis, path(bodies, event.a, axis).position(now), 0, now);
        if (!event.withStatic()) {
            set(bodies, event.b, axis, path(bodies, event.b, axis).position(now), 0, now);
        }
    }
}

/// Carries out one axis of an event.
template <class Real, class Path>
typename SequentialContinuous<Real, Path>::Outcome SequentialContinuous<Real, Path>::collide(
    const BodyView<Real>& bodies, const PairEvent& event, int axis, double sense) {
    const double now = event.time;
    const Path a = path(bodies, event.a, axis);
    const Path b = path(bodies, event.b, axis);
    const double va = a.speed(now);
    const double vb = b.speed(now);
    const double closing = (va - vb) * sense;
    if constexpr (falls) {
        const bool aOnB = gravity_[static_cast<std::size_t>(axis)] * sense > 0;
        const std::uint32_t upper = aOnB ? event.a : event.b;
        const std::uint32_t lower = aOnB ? event.b : event.a;
        const double pressure = (a.acceleration - b.acceleration) * sense;
        const double slack = rounding(a, b, reachOf(bodies, event.a, event.b, axis), now);
        if (holds(bodies, lower, axis) && comesToRest(closing, pressure, slack)) {
            const double down = aOnB ? sense : -sense;
            const double surface = surfaceFor(bodies, event, upper, lower, axis, down);
            setRests(bodies, upper, axis, true);
            set(bodies, upper, axis, surface, 0, now);
            return closing * closing > 2 * pressure * slack ? Outcome::Collision : Outcome::Touch;
        }
    }
    if (!(closing > creep(va, vb))) return Outcome::Nothing;
    if (restitution_ < 1) {
        collideGroups(bodies, event, axis, sense);
    } else if (event.withStatic()) {
        bounceOff(bodies, event, event.a, event.b, axis, sense);
    } else {
        exchange(bodies, event, axis, sense);
    }
    return restitution_ == 1 || closing >= restSpeed ? Outcome::Collision : Outcome::Touch;
}

/// Carries an event out. Returns whether any trajectory changed.
template <class Real, class Path>
bool SequentialContinuous<Real, Path>::resolve(const BodyView<Real>& bodies, const PairEvent& event,
                                               ContactRecord& record) {
    const double now = event.time;
    if constexpr (falls) {
        if (event.release) {
            const int axis = event.axes == axisX ? 0 : 1;
            const bool first = release(bodies, event.a, axis, now);
            if (first) changed(event.a);
            const bool second = !event.withStatic() && release(bodies, event.b, axis, now);
            if (second) changed(event.b);
            return first || second;
        }
    }
    const auto distance = [&](int axis) {
        return path(bodies, event.b, axis).position(now) -
               path(bodies, event.a, axis).position(now);
    };
    const double dx = distance(0);
    const double dy = distance(1);
    std::uint8_t axes = event.axes;
    if (axes == 0) {
        const double reachX = reachOf(bodies, event.a, event.b, 0);
        const double reachY = reachOf(bodies, event.a, event.b, 1);
        const auto least = leastPenetration(dx, dy, reachX, reachY);
        axes = least.axis;
        const int axis = axes == axisX ? 0 : 1;
        const double slack = rounding(path(bodies, event.a, axis), path(bodies, event.b, axis),
                                      axis == 0 ? reachX : reachY, now);
        if (restitution_ == 1 && least.depth > slack && separatedAlready(event)) return false;
    }
    const int senseX = dx >= 0 ? 1 : -1;
    const int senseY = dy >= 0 ? 1 : -1;
    const auto along = [&](int axis, int sense) {
        return (axes & axisBit(axis)) != 0 ? collide(bodies, event, axis, sense) : Outcome::Nothing;
    };
    const Outcome alongX = along(0, senseX);
    const Outcome alongY = along(1, senseY);
    if (alongX == Outcome::Nothing && alongY == Outcome::Nothing) return false;
    changed(event.a);
    if (!event.withStatic()) changed(event.b);
    for (const std::uint32_t row : groupChanged_) {
        if (row != event.a && row != event.b) changed(row);
    }
    groupChanged_.clear();
    const auto b = static_cast<std::int64_t>(event.b & ~staticBit);
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

template <class Real, class Path>
double SequentialContinuous<Real, Path>::advance(const BodyView<Real>& bodies,
                                                 const Partition<Real>& partition, Real reach,
                                                 double from, double to,
                                                 std::vector<ContactRecord>* records,
                                                 ResolveCounts& counts) {
    reach_ = reach;
    events_.begin(to, bodies.moving.entity, bodies.fixed.entity);
    const bool newPairs = candidates_.update(bodies, partition);
    if (newPairs) surveyed_ = false;  // speeds may have fallen
    if (newPairs) neighbours_.link(bodies.moving.size(), candidates_.moving(), candidates_.fixed());
    if (newPairs || to > horizon_) {
        // Meetings do not depend on steps, so they are found for as long as the pairs may last.
        const double life = reach > 0 ? static_cast<double>(partition.margin / reach) + 1 : 1.0;
        horizon_ = std::max(to, from + life * (to - from));
        findAll(bodies, from, horizon_);
        counts.pairsTested += candidates_.size();
    }
    const auto findForChanged = [&](double now) {
        for (const std::uint32_t row : changed_) findFor(bodies, row, now, horizon_);
        changed_.clear();
    };
    if constexpr (falls) releaseFromChanged(bodies, from);
    findForChanged(from);

#if defined(__GNUC__)
    // Brings what the events will read into the cache, all at once: one after the other they would
    // wait for each.
    for (const PairEvent& event : events_.due()) {
        for (const std::uint32_t row : {event.a, event.b}) {
            if ((row & staticBit) != 0) continue;
            for (const std::uint32_t b : neighbours_[row]) {
                if ((b & staticBit) == 0)
                    __builtin_prefetch(bodies.moving.anchors->rows.data() + b);
            }
        }
    }
#endif

    const std::uint64_t most = counts.contacts + mostEventsPerBody * (bodies.moving.size() + 1);
    while (!events_.empty()) {
        const PairEvent event = events_.pop();
        if (!isCurrent(event)) continue;
        if (++counts.contacts > most) {
            throw Error("the law 'continuous' found more than " +
                        std::to_string(mostEventsPerBody) + " events per body in a step");
        }
        ContactRecord record{};
        if (!resolve(bodies, event, record)) continue;
        if (record.axes != 0) {
            ++counts.collisions;
            if (records != nullptr) records->push_back(record);
        }
        if constexpr (falls) releaseFromChanged(bodies, event.time);
        for (const std::uint32_t row : changed_) {
            // The caller makes a partition that covers the new speed, and the search goes on there.
            if (leavesPartition(bodies, row, event.time, to)) return event.time;
        }
        findForChanged(event.time);
    }
    return to;
}

template <class Real, class Path>
std::size_t SequentialContinuous<Real, Path>::bytes() const {
    return candidates_.bytes() + neighbours_.bytes() + events_.bytes() +
           (stamps_.capacity() + changed_.capacity() + 2 * separated_.capacity() +
            groupA_.rows.capacity() + groupB_.rows.capacity() + groupChanged_.capacity() +
            2 * gathered_.capacity()) *
               sizeof(std::uint32_t);
}

template <class Real>
std::unique_ptr<ContinuousLaw<Real>> makeContinuousLaw(const SimulationConfig& config) {
    if (config.resolver != ResolverKind::Sequential) {
        throw NotAvailable("the law 'continuous' runs on the resolver 'sequential'");
    }
    if (config.gravity == Vec2(0, 0)) {
        return std::make_unique<SequentialContinuous<Real, StraightPath>>(config);
    }
    return std::make_unique<SequentialContinuous<Real, FallingPath>>(config);
}

template std::unique_ptr<ContinuousLaw<double>> makeContinuousLaw(const SimulationConfig&);
template std::unique_ptr<ContinuousLaw<float>> makeContinuousLaw(const SimulationConfig&);

}  // namespace quadrille
