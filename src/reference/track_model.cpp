#include "reference/track_model.hpp"

#include <algorithm>
#include <cmath>

#include "reference/boxes.hpp"

namespace quadrille::reference {
namespace {

constexpr double restSpeed = Oracle::restSpeed;
constexpr double creepSpeed = Oracle::creepSpeed;

/// Rounding of positions, relative to their magnitude; some thousand ulps, as errors add up.
constexpr double relativeRounding = 1e-12;

}  // namespace

TrackModel::TrackModel(const std::vector<Box>& boxes, const Vec2& gravity, double restitution)
    : gravity_{gravity.x(), gravity.y()}, restitution_(restitution), cellWidth_(cellWidth(boxes)) {
    for (const Box& box : boxes) {
        Body made;
        made.half = box.size / 2;
        made.mass = box.mass;
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
            .rounding = relativeRounding * (std::abs(a.at(now)) + std::abs(b.at(now)) + contact)};
}

bool TrackModel::collides(const Meeting& meeting) const {
    if (meeting.pressure > 0) return meeting.approach > -restSpeed;
    return meeting.approach > (restitution_ < 1 ? creepSpeed : 0);
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
        spans[std::size_t(k)] = inside(seen, contact[k]);
        if (seen.acceleration != 0) {
            // At rest on each other up to rounding: that is a contact, not a flight of 1e-16 px.
            const Meeting along = meet(i, j, k, now);
            const Meeting across = meet(i, j, 1 - k, now);
            if (along.pressure > 0 && std::abs(along.approach) < restSpeed &&
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

bool TrackModel::collide(std::int64_t i, std::int64_t j, int axis, double now,
                         std::vector<std::int64_t>& changed) {
    bool counts = false;
    bool anything = false;
    for (int k = 0; k < 2; ++k) {
        if ((axis & (k + 1)) == 0) continue;
        const Outcome outcome = collideAlong(k, i, j, now, changed);
        counts |= outcome == Outcome::Collision;
        anything |= outcome != Outcome::Nothing;
    }
    // The prediction is used up even if nothing came of it.
    if (!anything) changed.push_back(i);
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    return counts;
}

TrackModel::Outcome TrackModel::collideAlong(int k, std::int64_t i, std::int64_t j, double now,
                                             std::vector<std::int64_t>& changed) {
    const Meeting meeting = meet(i, j, k, now);
    if (!collides(meeting)) return Outcome::Nothing;
    const Outcome outcome =
        meeting.approach >= restSpeed || (restitution_ == 1 && meeting.pressure <= 0)
            ? Outcome::Collision
            : Outcome::Contact;
    const double rebound = restitution_ * std::max(meeting.approach, 0.0);
    if (rebound < restSpeed && (restitution_ < 1 || meeting.pressure > 0)) {
        settle(k, i, j, meeting, now, changed);
        return outcome;
    }
    changed.push_back(i);
    if (j < 0) {
        bounceOff(k, i, j, meeting, now);
    } else {
        changed.push_back(j);
        const Track a = moving(i).track[std::size_t(k)];
        const Track b = moving(j).track[std::size_t(k)];
        if (restitution_ == 1 && moving(i).mass == moving(j).mass &&
            a.acceleration == b.acceleration && !moving(i).rests(k)) {
            exchange(k, i, j, meeting);
        } else {
            const double mi = moving(i).mass;
            const double mj = moving(j).mass;
            const double impulse = (1 + restitution_) * (a.speed(now) - b.speed(now)) / (mi + mj);
            fly(k, i, a.at(now), a.speed(now) - mj * impulse, now);
            fly(k, j, b.at(now), b.speed(now) + mi * impulse, now);
        }
        letGoRestingOn(j, now, changed);
    }
    letGoRestingOn(i, now, changed);
    return outcome;
}

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
    if (restitution_ == 1 && track.acceleration == 0) {
        track.position = 2 * border - track.position;
        track.velocity = -track.velocity;
        // A deep overlap has no border to mirror at: the position at this instant stays.
        if (!exact) track = {border, track.velocity, 0, now};
    } else {
        fly(k, i, border, -restitution_ * track.speed(now), now);
    }
}

/// The rebound is too slow to be one.
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
    } else {
        const double mi = body(i).mass;
        const double mj = body(j).mass;
        const double common = (mi * a.speed(now) + mj * b.speed(now)) / (mi + mj);
        fly(k, i, a.at(now), common, now);
        fly(k, j, b.at(now), common, now);
        changed.push_back(i);
        changed.push_back(j);
        letGoRestingOn(i, now, changed);
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
