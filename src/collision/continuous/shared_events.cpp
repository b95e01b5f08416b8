#include "collision/continuous/shared_events.hpp"

#include <algorithm>
#include <span>

namespace quadrille {

template <class Real, class Path>
bool SharedEvents<Real, Path>::isWorthATry() {
    if (waiting_ == 0) return true;
    --waiting_;
    return false;
}

template <class Real, class Path>
bool SharedEvents<Real, Path>::run(const BodyView<Real>& bodies, const Search& search,
                                   EventLoopState& whole, const EventWindow& window, double way,
                                   std::vector<ContactRecord>* records, ResolveCounts& counts) {
    if (team_.workersFor(whole.queue.dueCount(), &Thresholds::events) == 1) return false;
    if (!tryRun(bodies, search, whole, window, way, records != nullptr)) {
        // Most scenes stay as dense as they are.
        pause_ = std::min(std::max(2 * pause_, 1u), team_.thresholds().longestPause);
        waiting_ = pause_;
        return false;
    }
    pause_ = 0;
    finish(whole, records, counts);
    return true;
}

template <class Real, class Path>
bool SharedEvents<Real, Path>::tryRun(const BodyView<Real>& bodies, const Search& search,
                                      EventLoopState& whole, const EventWindow& window, double way,
                                      bool record) {
    due_.clear();
    whole.queue.forEachDue([&](const PairEvent& event) {
        if (search.isCurrent(event)) due_.push_back(event);
    });
    const bool split = islands_.split(bodies, search.neighbours(), due_, way);
    if (split) {
        const Bursts& bursts = whole.bursts.settled();
        if (search.motion().restitution < 1) whole.gathered->resize(search.rows());
        team_.run(team_.size(), [&](unsigned worker) { keep(search, worker); });
        team_.run(team_.size(), [&](unsigned worker) {
            runShare(search, whole, bursts, window, record, worker);
        });
    }
    const bool complete = split && allComplete(window.mostEvents);
    team_.run(team_.size(), [&](unsigned worker) {
        if (complete) findAcross(search, window, shares_[worker]);
        islands_.forget(worker);
    });
    if (complete && allComplete(window.mostEvents)) return true;
    if (split) undo(search, whole);
    return false;
}

/// Keeps what bodies of the islands were.
template <class Real, class Path>
void SharedEvents<Real, Path>::keep(const Search& search, unsigned worker) {
    const auto& m = search.motion().bodies.moving;
    std::vector<Before>& before = shares_[worker].before;
    before.clear();
    for (const std::uint32_t row : islands_.claimedBy(worker)) {
        const std::uint8_t rests = Path::falls ? m.rests[row] : 0;
        before.push_back({row, search.stamp(row), m.anchors[row], rests});
    }
}

template <class Real, class Path>
void SharedEvents<Real, Path>::runShare(const Search& search, const EventLoopState& whole,
                                        const Bursts& bursts, const EventWindow& window,
                                        bool record, unsigned worker) {
    Share& own = shares_[worker];
    own.across.clear();
    own.records.clear();
    own.counts = {};
    own.state.queue.beginShare(whole.queue, islands_.eventsOf(worker));
    own.state.changed.clear();
    own.state.instant = whole.instant;
    own.state.separated = whole.separated;
    own.state.bursts = bursts;
    own.state.mayRest = whole.mayRest;
    own.state.gathered = whole.gathered;
    own.state.gathering = whole.gathering;

    EventWindow part = window;
    part.islands = &islands_;
    part.worker = worker;
    const auto admit = [&](const PairEvent& event) {
        if (++own.counts.events > window.mostEvents) return false;
        return part.mayChange(BodyRef::moving(event.a)) &&
               (event.withStatic() || part.mayChange(event.b));
    };
    const auto collided = [&](const PairEvent& event, const ContactRecord& made) {
        ++own.counts.contacts;
        ++own.counts.collisions;
        if (!record) return;
        // An event may come at once after one that it would have preceded, had it been known.
        const bool follows =
            own.records.empty() || own.state.queue.isLater(event, own.records.back().after);
        own.records.push_back({follows ? event : own.records.back().after, 0, made});
    };
    const auto othersOf = [&](std::uint32_t row) -> std::span<const BodyRef> {
        islands_.markChanged(row);
        own.others.clear();
        for (const BodyRef b : search.neighbours()[row]) {
            if (part.maySee(b)) {
                own.others.push_back(b);
            } else {
                own.across.push_back({row, search.stamp(row), b});
            }
        }
        return own.others;
    };
    Loop loop(search, own.state, part);
    own.complete = loop.run(admit, collided, othersOf);
}

/// Finds what bodies of this worker do after the step with those of others. Of two bodies that both
/// have changed, the first one's worker does it.
template <class Real, class Path>
void SharedEvents<Real, Path>::findAcross(const Search& search, const EventWindow& window,
                                          Share& share) {
    for (const Across& across : share.across) {
        if (search.stamp(across.row) != across.stamp) continue;  // it comes again
        const std::uint32_t other = across.other.row();
        if (islands_.isChanged(other) && other < across.row) continue;
        search.findFor(across.row, {&across.other, 1}, window.to, window.horizon,
                       share.state.queue);
    }
    share.complete = share.state.queue.empty();
}

template <class Real, class Path>
bool SharedEvents<Real, Path>::allComplete(std::uint64_t mostEvents) const {
    std::uint64_t events = 0;
    for (const Share& share : shares_) {
        if (!share.complete) return false;
        events += share.counts.events;
    }
    return events <= mostEvents;
}

template <class Real, class Path>
void SharedEvents<Real, Path>::undo(const Search& search, EventLoopState& whole) {
    const auto& m = search.motion().bodies.moving;
    for (const Share& share : shares_) {
        whole.gathering = std::max(whole.gathering, share.state.gathering);
        for (const Before& before : share.before) {
            if (search.stamp(before.row) == before.stamp) continue;
            search.motion().takeBack(before.row, before.anchor);
            if constexpr (Path::falls) m.rests[before.row] = before.rests;
            search.restore(before.row, before.stamp);
        }
    }
}

template <class Real, class Path>
void SharedEvents<Real, Path>::finish(EventLoopState& whole, std::vector<ContactRecord>* records,
                                      ResolveCounts& counts) {
    whole.queue.dropDue();
    records_.clear();
    for (Share& share : shares_) {
        EventLoopState& state = share.state;
        whole.queue.take(state.queue);
        whole.bursts.take(state.bursts);
        whole.mayRest = whole.mayRest || state.mayRest;
        whole.gathering = std::max(whole.gathering, state.gathering);
        counts.events += share.counts.events;
        counts.contacts += share.counts.contacts;
        counts.collisions += share.counts.collisions;
        records_.insert(records_.end(), share.records.begin(), share.records.end());
        if (state.instant > whole.instant) {
            whole.instant = state.instant;
            whole.separated.clear();
        }
        if (state.instant < whole.instant) continue;
        for (const auto& pair : state.separated) {
            const auto& known = whole.separated;
            if (std::find(known.begin(), known.end(), pair) == known.end()) {
                whole.separated.push_back(pair);
            }
        }
    }
    if (records == nullptr) return;
    for (std::size_t i = 0; i < records_.size(); ++i) records_[i].number = i;
    std::sort(records_.begin(), records_.end(), [&](const Recorded& p, const Recorded& q) {
        if (whole.queue.isLater(q.after, p.after)) return true;
        return !whole.queue.isLater(p.after, q.after) && p.number < q.number;
    });
    for (const Recorded& recorded : records_) records->push_back(recorded.record);
}

template <class Real, class Path>
std::size_t SharedEvents<Real, Path>::bytes() const {
    std::size_t sum = islands_.bytes() + shares_.capacity() * sizeof(Share) +
                      due_.capacity() * sizeof(PairEvent) + records_.capacity() * sizeof(Recorded);
    for (const Share& share : shares_) {
        sum += share.state.bytes() + share.before.capacity() * sizeof(Before) +
               share.across.capacity() * sizeof(Across) +
               share.others.capacity() * sizeof(BodyRef) +
               share.records.capacity() * sizeof(Recorded);
    }
    return sum;
}

template class SharedEvents<double, StraightPath>;
template class SharedEvents<double, FallingPath>;
template class SharedEvents<float, StraightPath>;
template class SharedEvents<float, FallingPath>;

}  // namespace quadrille
