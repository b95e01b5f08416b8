#include "collision/continuous/event_loop.hpp"

#include <algorithm>
#include <utility>

#include "collision/make_record.hpp"

namespace quadrille {

/// Notes that the body's path is another one.
template <class Real, class Path>
void EventLoop<Real, Path>::changed(std::uint32_t row) {
    search_.changed(row);
    state_.changed.push_back(row);
}

/// Whether the pair has collided already at this instant.
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

/// Whether one of the bodies collides so often at once that it gets nowhere.
template <class Real, class Path>
bool EventLoop<Real, Path>::isJammed(const PairEvent& event, const EventContact& contact) {
    // What loses something each time ends by itself.
    const bool lossless = motion_.restitution == 1;
    const double touching =
        lossless ? touchingFor(motion_, event, contact.axes) : Bursts::notTouching;
    return state_.bursts.note({event, contact.deep, touching}).jam(contact.deep);
}

/// Carries an event out. Returns whether any path changed.
template <class Real, class Path>
bool EventLoop<Real, Path>::resolve(const PairEvent& event, ContactRecord& record) {
    if constexpr (falls) {
        if (event.release) return resting_.release(event);
    }
    const EventContact contact = contactOf(motion_, event);
    if (contact.deep && motion_.restitution == 1 && separatedAlready(event)) return false;
    Motion motion = motion_;
    if (isJammed(event, contact)) {
        jammed_ = true;
        if (window_.isShared() || (contact.deep && !event.withStatic())) return false;
        motion.restitution = 0;
    }
    const auto pushed = [&](int along, double side) {
        return groups_.collide(motion, event, along, side);
    };
    const EventOutcomes done = collide(motion, event, contact, pushed);
    if (!done.changes()) return false;
    if constexpr (falls) state_.mayRest = state_.mayRest || done.rests();
    changed(event.a);
    if (!event.withStatic()) changed(event.b.row());
    for (const std::uint32_t row : state_.groupChanged) {
        if (row != event.a && BodyRef::moving(row) != event.b) changed(row);
    }
    state_.groupChanged.clear();
    record = makeRecord(event, contact, done);
    return true;
}

template class EventLoop<double, StraightPath>;
template class EventLoop<double, FallingPath>;
template class EventLoop<float, StraightPath>;
template class EventLoop<float, FallingPath>;

}  // namespace quadrille
