#include "reference/track_model.hpp"

#include <algorithm>
#include <cmath>

#include "reference/boxes.hpp"

namespace quadrille::reference {
namespace {

constexpr double restSpeed = Oracle::restSpeed;

/// Rounding of positions, relative to their magnitude; some thousand ulps, as errors add up.
constexpr double relativeRounding = 1e-12;

/// Approaches up to this, px/s, come from rounding.
double creep(double va, double vb, double restitution) {
    constexpr double eps = 1e-15;
    if (restitution == 1) return 0;
    return std::max(Oracle::creepSpeed, eps * (std::abs(va) + std::abs(vb)));
}

}  // namespace

TrackModel::TrackModel(const std::vector<Box>& boxes, const Vec2& gravity, double restitution,
                       Ties ties)
    : gravity_{gravity.x(), gravity.y()},
      restitution_(restitution),
      ties_(ties),
      cellWidth_(cellWidth(boxes)) {
    for (const Box& box : boxes) {
        Body made;
        made.half = box.size / 2;
        made.mass = box.mass;
        made.label = box.label;
        for (int k = 0; k < 2; ++k) {
            Track& track = made.track[std::size_t(k)];
            track.position = box.position[k];
            if (box.isStatic) continue;
            track.velocity = box.velocity[k];
            track.acceleration = gravity_[std::size_t(k)];
        }
        (box.isStatic ? fixed_ : moving_).push_back(made);
    }
}

Cell TrackModel::cellAtStart(std::int64_t i) const {
    const Vec2 at = position(i, 0) / cellWidth_;
    return {std::int64_t(std::floor(at.x())), std::int64_t(std::floor(at.y()))};
}

/// Lower is earlier, at one instant.
std::uint32_t TrackModel::priority(std::int64_t i, std::int64_t j) const {
    if (ties_ == Ties::ByIds) return 0;
    std::uint64_t bits = (std::uint64_t(body(i).label) << 32) | body(j).label;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return std::uint32_t((bits ^ (bits >> 31)) >> 32);
}

Vec2 TrackModel::position(std::int64_t i, double time) const {
    return {body(i).track[0].at(time), body(i).track[1].at(time)};
}

Vec2 TrackModel::velocity(std::int64_t i, double time) const {
    return {body(i).track[0].speed(time), body(i).track[1].speed(time)};
}

// ---- prediction

TrackModel::Meeting TrackModel::meet(std::int64_t i, std::int64_t j, int k, double now) const {
    const Track& a = body(i).track[std::size_t(k)];
    const Track& b = body(j).track[std::size_t(k)];
    const Track seen = relative(a, b);
    const double d = seen.at(now);
    const double sign = d < 0 ? -1 : 1;
    const double contact = body(i).half[k] + body(j).half[k];
    return {.sign = sign,
            .distance = sign * d,
            .contact = contact,
            .approach = -sign * seen.speed(now),
            .pressure = -sign * seen.acceleration,
            .rounding = Oracle::touchDistance * contact +
                        relativeRounding * (std::abs(a.at(now)) + std::abs(b.at(now)) + contact),
            .creep = creep(a.speed(now), b.speed(now), restitution_)};
}

/// Whether the rebound, pressed together as the pair is, does not rise above rounding.
bool TrackModel::comesToRest(const Meeting& meeting, double restitution) {
    const double parting = meeting.approach > 0 ? restitution * meeting.approach : meeting.approach;
    return meeting.pressure > 0 && parting * parting <= 2 * meeting.pressure * meeting.rounding;
}

bool TrackModel::collides(const Meeting& meeting) const {
    return comesToRest(meeting, restitution_) || meeting.approach > meeting.creep;
}

/// What happens to a pair that overlaps from before `now` until `until`, or that is pressed
/// together at rest.
std::optional<Hit<double>> TrackModel::touching(std::int64_t i, std::int64_t j, double now,
                                                double until) const {
    const std::array<Meeting, 2> meetings{meet(i, j, 0, now), meet(i, j, 1, now)};
    const auto depth = [&](int k) {
        return meetings[std::size_t(k)].contact - meetings[std::size_t(k)].distance;
    };
    const auto byRounding = [&](int k) { return depth(k) <= meetings[std::size_t(k)].rounding; };
    if (byRounding(0) && byRounding(1)) {
        if (collides(meetings[0]) && collides(meetings[1])) return Hit<double>{now, 3};
        return std::nullopt;
    }
    const int k = depth(0) <= depth(1) ? 0 : 1;
    const Meeting& least = meetings[std::size_t(k)];
    if (collides(least)) return Hit<double>{now, k + 1};
    if (least.pressure > 0) {
        // They part, and would fall back inside each other: look again at the turning point.
        const double turn = now - least.approach / least.pressure;
        if (turn < until) return Hit<double>{turn, k + 1};
    }
    return std::nullopt;
}

std::optional<Hit<double>> TrackModel::hit(std::int64_t i, std::int64_t j, double now) const {
    const Body& a = body(i);
    const Body& b = body(j);
    const Vec2 contact = a.half + b.half;
    std::array<Spans, 2> spans;
    for (int k = 0; k < 2; ++k) {
        const Track seen = relative(a.track[std::size_t(k)], b.track[std::size_t(k)]);
        // Rounding must not make a box trip over the edges of the floor that it slides on.
        const bool falls = gravity_[0] != 0 || gravity_[1] != 0;
        const bool alongside = falls && seen.velocity == 0 && seen.acceleration == 0;
        const double room = alongside ? meet(i, j, k, now).rounding : 0;
        spans[std::size_t(k)] = inside(seen, contact[k] - room);
        if (seen.acceleration != 0) {
            // At rest on each other up to rounding: that is a contact, not a flight of 1e-16 px.
            const Meeting along = meet(i, j, k, now);
            const Meeting across = meet(i, j, 1 - k, now);
            if (comesToRest(along, restitution_) &&
                std::abs(along.distance - along.contact) <= along.rounding &&
                across.distance < across.contact - across.rounding) {
                return Hit<double>{now, k + 1};
            }
        }
    }
    for (const Span& x : spans[0]) {
        for (const Span& y : spans[1]) {
            const double low = std::max(x.low, y.low);
            const double high = std::min(x.high, y.high);
            if (!(low < high) || high <= now) continue;
            if (low < now) {
                if (const auto found = touching(i, j, now, high)) return found;
                continue;
            }
            const int axis = x.low > y.low ? 1 : x.low < y.low ? 2 : 3;
            if (low == now && axis < 3 && !collides(meet(i, j, axis - 1, now))) continue;
            return Hit<double>{low, axis};
        }
    }
    return std::nullopt;
}

std::optional<Crossing<double>> TrackModel::crossing(std::int64_t i, const Cell& cell,
                                                     double now) const {
    std::optional<Crossing<double>> next;
    for (int k = 0; k < 2; ++k) {
        const std::int64_t index = k == 0 ? cell.x : cell.y;
        for (const int side : {-1, 1}) {
            const double border = double(side < 0 ? index : index + 1) * cellWidth_;
            const auto time = passes(body(i).track[std::size_t(k)], border, side, now);
            if (time && (!next || *time < next->time)) next = {*time, k + 1, side};
        }
    }
    return next;
}

std::optional<double> TrackModel::release(std::int64_t i, double now) const {
    const Body& a = body(i);
    std::optional<double> next;
    for (int k = 0; k < 2; ++k) {
        if (!a.rests(k)) continue;
        const auto across = std::size_t(1 - k);
        const Body& b = body(a.support[std::size_t(k)]);
        const double contact = a.half[1 - k] + b.half[1 - k];
        double end = now;
        for (const Span& span : inside(relative(a.track[across], b.track[across]), contact)) {
            if (span.low <= now && now < span.high) end = span.high;
        }
        if (end < never && (!next || end < *next)) next = end;
    }
    return next;
}

// ---- collision

bool TrackModel::collide(std::int64_t i, std::int64_t j, int axis, double now, const Near& near,
                         std::vector<std::int64_t>& changed) {
    Manner manner{now, restitution_, near};
    const int only = axis - 1;
    bool deep = false;
    if (axis < 3) {
        const Meeting meeting = meet(i, j, only, now);
        deep = meeting.contact - meeting.distance > meeting.rounding;
    }
    bool passes = deep && restitution_ == 1 && separatedAlready(i, j, now);
    if (!passes && isJammed(i, j, axis, deep, now)) {
        ++choices_.jammed;
        manner.restitution = 0;
        passes = deep && j >= 0;
    }
    bool counts = false;
    bool anything = false;
    for (int k = 0; k < 2 && !passes; ++k) {
        if ((axis & (k + 1)) == 0) continue;
        const Outcome outcome = collideAlong(k, i, j, manner, changed);
        counts |= outcome == Outcome::Collision;
        anything |= outcome != Outcome::Nothing;
    }
    // The prediction is used up even if nothing came of it; but who passes is not asked again.
    if (!anything && !passes) changed.push_back(i);
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    return counts;
}

/// Whether the pair, deep inside each other, has collided at this instant.
bool TrackModel::separatedAlready(std::int64_t i, std::int64_t j, double now) {
    if (now != instant_) separated_.clear();
    instant_ = now;
    return !separated_.insert({i, j}).second;
}

/// Counts the collision, and says whether one of the boxes has too many.
bool TrackModel::isJammed(std::int64_t i, std::int64_t j, int axis, bool deep, double now) {
    const auto cell = [](double time, double perSecond) { return std::floor(time * perSecond); };
    bool jammed = false;
    double since = 0;  // for how long the pair has been touching at most, s
    for (int k = 0; k < 2; ++k) {
        if ((axis & (k + 1)) == 0) continue;
        const Meeting meeting = meet(i, j, k, now);
        const double speed = std::abs(meeting.approach);
        since =
            std::max(since, speed == 0 ? never : Oracle::touchDistance * meeting.contact / speed);
    }
    for (const std::int64_t id : {i, j}) {
        if (id < 0) continue;
        Body& box = moving(id);
        if (cell(now, 0x1p30) != cell(box.last, 0x1p30)) box.atOnce = box.deepAtOnce = 0;
        const bool fresh = cell(now, 0x1p15) != cell(box.last, 0x1p15);
        if (fresh) box.touching = 0;
        ++box.atOnce;
        box.deepAtOnce += deep;
        box.touching += !fresh && restitution_ == 1 && now - box.last <= since;
        box.held = j < 0 ? (now == box.last ? box.held : 0) + 1 : 0;
        box.last = now;
        jammed |= box.held > Oracle::mostHeld || box.atOnce > Oracle::mostAtOnce ||
                  box.touching > Oracle::mostAtOnce ||
                  (deep && box.deepAtOnce > Oracle::mostDeepAtOnce);
    }
    return jammed;
}

TrackModel::Outcome TrackModel::collideAlong(int k, std::int64_t i, std::int64_t j,
                                             const Manner& manner,
                                             std::vector<std::int64_t>& changed) {
    const double now = manner.now;
    const Meeting meeting = meet(i, j, k, now);
    const Track a = body(i).track[std::size_t(k)];
    const Track b = body(j).track[std::size_t(k)];
    if (comesToRest(meeting, manner.restitution)) {
        settle(k, i, j, meeting, now, changed);
        const bool hits =
            meeting.approach * meeting.approach > 2 * meeting.pressure * meeting.rounding;
        return hits ? Outcome::Collision : Outcome::Contact;
    }
    if (!(meeting.approach > creep(a.speed(now), b.speed(now), manner.restitution))) {
        return Outcome::Nothing;
    }
    if (manner.restitution < 1) {
        push(k, i, j, meeting, manner, changed);
        return meeting.approach >= restSpeed ? Outcome::Collision : Outcome::Contact;
    }
    changed.push_back(i);
    if (j < 0) {
        bounceOff(k, i, j, meeting, now);
    } else {
        changed.push_back(j);
        if (moving(i).mass == moving(j).mass && a.acceleration == b.acceleration &&
            !moving(i).rests(k)) {
            exchange(k, i, j, meeting);
        } else {
            const double mi = moving(i).mass;
            const double mj = moving(j).mass;
            const double impulse = 2 * (a.speed(now) - b.speed(now)) / (mi + mj);
            fly(k, i, a.at(now), a.speed(now) - mj * impulse, now);
            fly(k, j, b.at(now), b.speed(now) + mi * impulse, now);
        }
        letGoRestingOn(j, now, changed);
    }
    letGoRestingOn(i, now, changed);
    return Outcome::Collision;
}

// ---- restitution below 1

/// Whether a push in a direction does not move it.
bool TrackModel::holds(std::int64_t i, int k, double direction) const {
    return i < 0 || (body(i).rests(k) && gravity_[std::size_t(k)] * direction > 0);
}

/// What a push of box i in a direction pushes.
TrackModel::Side TrackModel::sideOf(std::int64_t i, int k, double direction,
                                    const Manner& manner) const {
    const double now = manner.now;
    Side side{.boxes = {i}, .mass = 0, .held = holds(i, k, direction)};
    if (i < 0) return side;
    const auto pushes = [&](std::int64_t a, std::int64_t b) {
        const Meeting along = meet(a, b, k, now);
        if (along.sign * direction < 0 ||
            std::abs(along.distance - along.contact) > along.rounding) {
            return false;
        }
        const double va = body(a).track[std::size_t(k)].speed(now);
        const double vb = body(b).track[std::size_t(k)].speed(now);
        if (std::abs(va - vb) > creep(va, vb, manner.restitution)) return false;
        const Meeting across = meet(a, b, 1 - k, now);
        return across.distance < across.contact - across.rounding;
    };
    const auto look = [&](std::int64_t a, std::int64_t b) {
        if (side.held || a == b || !pushes(a, b)) return;
        side.held = holds(b, k, direction);
        if (b < 0 || std::find(side.boxes.begin(), side.boxes.end(), b) != side.boxes.end()) return;
        side.boxes.push_back(b);
    };
    for (std::size_t n = 0; n < side.boxes.size() && !side.held; ++n) {
        const std::int64_t a = side.boxes[n];
        for (const std::int64_t b : manner.near(a)) look(a, b);
        for (std::int64_t s = 0; s < staticCount(); ++s) look(a, -1 - s);
    }
    for (const std::int64_t box : side.boxes) side.mass += body(box).mass;
    return side;
}

/// Collides what is pushed along on either side.
void TrackModel::push(int k, std::int64_t i, std::int64_t j, const Meeting& meeting,
                      const Manner& manner, std::vector<std::int64_t>& changed) {
    const double now = manner.now;
    const Side below = sideOf(i, k, -meeting.sign, manner);
    const Side above = sideOf(j, k, meeting.sign, manner);
    if (below.boxes.size() + above.boxes.size() > 2 || (below.held && i >= 0) ||
        (above.held && j >= 0)) {
        ++choices_.pushed;
    }
    const double vi = body(i).track[std::size_t(k)].speed(now);
    const double vj = body(j).track[std::size_t(k)].speed(now);
    const double e = manner.restitution;
    const double bounce = e * std::abs(vi - vj) >= restSpeed ? e : 0;
    double newI = 0;
    double newJ = 0;
    if (!below.held && !above.held) {
        const double common = (below.mass * vi + above.mass * vj) / (below.mass + above.mass);
        newI = common - bounce * above.mass / (below.mass + above.mass) * (vi - vj);
        newJ = common + bounce * below.mass / (below.mass + above.mass) * (vi - vj);
    } else if (below.held) {
        newJ = bounce * (vi - vj);
    } else {
        newI = -bounce * (vi - vj);
    }
    const auto go = [&](const Side& side, std::int64_t first, double velocity) {
        if (side.held) {
            if (first < 0) return;
            Track& track = moving(first).track[std::size_t(k)];
            if (track.speed(now) == 0) return;
            track = {track.at(now), 0, track.acceleration, now};
            changed.push_back(first);
            return;
        }
        for (const std::int64_t box : side.boxes) {
            fly(k, box, body(box).track[std::size_t(k)].at(now), velocity, now);
            changed.push_back(box);
        }
        for (const std::int64_t box : side.boxes) letGoRestingOn(box, now, changed);
    };
    go(below, i, newI);
    if (below.held && above.held) newJ = 0;
    go(above, j, newJ);
}

// ---- restitution 1

/// Equal masses: each goes on along the other's trajectory, offset by the distance of contact.
void TrackModel::exchange(int k, std::int64_t i, std::int64_t j, const Meeting& meeting) {
    const bool exact = std::abs(meeting.distance - meeting.contact) <= meeting.rounding;
    const double offset = meeting.sign * (exact ? meeting.contact : meeting.distance);
    Track& a = moving(i).track[std::size_t(k)];
    Track& b = moving(j).track[std::size_t(k)];
    std::swap(a, b);
    a.position -= offset;
    b.position += offset;
}

void TrackModel::bounceOff(int k, std::int64_t i, std::int64_t j, const Meeting& meeting,
                           double now) {
    Track& track = moving(i).track[std::size_t(k)];
    const bool exact = std::abs(meeting.distance - meeting.contact) <= meeting.rounding;
    const double border =
        exact ? body(j).track[std::size_t(k)].position - meeting.sign * meeting.contact
              : track.at(now);
    if (track.acceleration == 0) {
        track.position = 2 * border - track.position;
        track.velocity = -track.velocity;
        // A deep overlap has no border to mirror at: the position at this instant stays.
        if (!exact) track = {border, track.velocity, 0, now};
    } else {
        fly(k, i, border, -track.speed(now), now);
    }
}

/// Gravity holds the pair together: one comes to rest on the other.
void TrackModel::settle(int k, std::int64_t i, std::int64_t j, const Meeting& meeting, double now,
                        std::vector<std::int64_t>& changed) {
    const bool exact = std::abs(meeting.distance - meeting.contact) <= meeting.rounding;
    const double offset = meeting.sign * (exact ? meeting.contact : meeting.distance);
    const Track a = body(i).track[std::size_t(k)];
    const Track b = body(j).track[std::size_t(k)];
    const double pull = gravity_[std::size_t(k)];
    if (j < 0 || (body(j).rests(k) && meeting.pressure > 0)) {
        const double at = b.at(now) - offset;
        if (pull * meeting.sign > 0) {
            restOn(k, i, j, at, b.speed(now), now);
        } else {
            fly(k, i, at, b.speed(now), now);
        }
        changed.push_back(i);
        letGoRestingOn(i, now, changed);
    } else if (body(i).rests(k) && meeting.pressure > 0) {
        restOn(k, j, i, a.at(now) + offset, a.speed(now), now);
        changed.push_back(j);
        letGoRestingOn(j, now, changed);
    }
}

void TrackModel::restOn(int k, std::int64_t i, std::int64_t support, double position,
                        double velocity, double now) {
    fly(k, i, position, velocity, now);
    moving(i).track[std::size_t(k)].acceleration = 0;
    moving(i).support[std::size_t(k)] = support;
    ++resting_;
}

/// A new anchor, in free flight.
void TrackModel::fly(int k, std::int64_t i, double position, double velocity, double now) {
    if (moving(i).rests(k)) --resting_;
    moving(i).support[std::size_t(k)] = nothing;
    moving(i).track[std::size_t(k)] = {position, velocity, gravity_[std::size_t(k)], now};
}

void TrackModel::letGo(std::int64_t i, double now, std::vector<std::int64_t>& changed) {
    for (int k = 0; k < 2; ++k) {
        if (!moving(i).rests(k)) continue;
        const Track& track = moving(i).track[std::size_t(k)];
        fly(k, i, track.at(now), track.speed(now), now);
    }
    changed.push_back(i);
    letGoRestingOn(i, now, changed);
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
}

void TrackModel::letGoRestingOn(std::int64_t support, double now,
                                std::vector<std::int64_t>& changed) {
    if (resting_ == 0) return;
    for (std::int64_t i = 0; i < movingCount(); ++i) {
        const auto& under = moving(i).support;
        if (i != support && (under[0] == support || under[1] == support)) letGo(i, now, changed);
    }
}

}  // namespace quadrille::reference
