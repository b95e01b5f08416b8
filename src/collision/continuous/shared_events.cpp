#include "collision/continuous/shared_events.hpp"

#include <algorithm>
#include <span>

namespace quadrille {

template <class Real>
bool SharedEvents<Real>::run(const BodyView<Real>& bodies, const Search& search,
                             EventLoopState& whole, const EventWindow& window, double way,
                             std::vector<ContactRecord>* records, ResolveCounts& counts) {
    if (team_.workersFor(whole.queue.dueCount(), &Thresholds::events) == 1) return false;
    if (waiting_ > 0) {
        --waiting_;
        return false;
    }
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

template <class Real>
bool SharedEvents<Real>::tryRun(const BodyView<Real>& bodies, const Search& search,
                                EventLoopState& whole, const EventWindow& window, double way,
                                bool record) {
    due_.clear();
    whole.queue.forEachDue([&](const PairEvent& event) {
        if (search.isCurrent(event)) due_.push_back(event);
    });
    const bool split = islands_.split(bodies, search.neighbours(), due_, way);
    if (split) {
        const Bursts& bursts = whole.bursts.settled();
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
    if (split) undo(search);
    return false;
}

template <class Real>
void SharedEvents<Real>::runShare(const Search& search, const EventLoopState& whole,
                                  const Bursts& bursts, const EventWindow& window, bool record,
                                  unsigned worker) {
    Share& own = shares_[worker];
    const auto& m = search.motion().bodies.moving;
    own.before.clear();
    own.across.clear();
    own.records.clear();
    own.counts = {};
    own.state.queue.beginShare(whole.queue, islands_.eventsOf(worker));
    own.state.changed.clear();
    own.state.instant = whole.instant;
    own.state.separated = whole.separated;
    own.state.bursts = bursts;

    const auto admit = [&](const PairEvent& event) {
        if (++own.counts.events > window.mostEvents) return false;
        if (!islands_.belongsTo(event.a, worker)) return false;
        own.before.push_back({event.a, search.stamp(event.a), m.anchors[event.a]});
        if (event.withStatic()) return true;
        const std::uint32_t b = event.b.row();
        if (!islands_.belongsTo(b, worker)) return false;
        own.before.push_back({b, search.stamp(b), m.anchors[b]});
        return true;
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
        own.others.clear();
        for (const BodyRef b : search.neighbours()[row]) {
            if (!b.isStatic() && islands_.belongsToAnother(b.row(), worker)) {
                own.across.push_back({row, search.stamp(row), b});
            } else {
                own.others.push_back(b);
            }
        }
        return own.others;
    };
    EventWindow part = window;
    part.share = true;
    Loop loop(search, own.state, part);
    own.complete = loop.run(admit, collided, othersOf);
    for (const Before& before : own.before) {
        if (search.stamp(before.row) != before.stamp) islands_.markChanged(before.row);
    }
}

/// Finds what bodies of this worker do after the step with those of others. Of two bodies that both
/// have changed, the first one's worker does it.
template <class Real>
void SharedEvents<Real>::findAcross(const Search& search, const EventWindow& window, Share& share) {
    for (const Across& across : share.across) {
        if (search.stamp(across.row) != across.stamp) continue;  // it comes again
        const std::uint32_t other = across.other.row();
        if (islands_.isChanged(other) && other < across.row) continue;
        search.findFor(across.row, {&across.other, 1}, window.to, window.horizon,
                       share.state.queue);
    }
    share.complete = share.state.queue.empty();
}

template <class Real>
bool SharedEvents<Real>::allComplete(std::uint64_t mostEvents) const {
    std::uint64_t events = 0;
    for (const Share& share : shares_) {
        if (!share.complete) return false;
        events += share.counts.events;
    }
    return events <= mostEvents;
}

template <class Real>
void SharedEvents<Real>::undo(const Search& search) {
    const auto& m = search.motion().bodies.moving;
    for (const Share& share : shares_) {
        for (std::size_t i = share.before.size(); i-- > 0;) {
            const Before& before = share.before[i];
            m.anchors[before.row] = before.anchor;
            m.vx[before.row] = before.anchor.vx;
            m.vy[before.row] = before.anchor.vy;
            search.restore(before.row, before.stamp);
        }
    }
}

template <class Real>
void SharedEvents<Real>::finish(EventLoopState& whole, std::vector<ContactRecord>* records,
                                ResolveCounts& counts) {
    whole.queue.dropDue();
    records_.clear();
    for (Share& share : shares_) {
        EventLoopState& state = share.state;
        whole.queue.take(state.queue);
        whole.bursts.take(state.bursts);
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

template <class Real>
std::size_t SharedEvents<Real>::bytes() const {
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

template class SharedEvents<double>;
template class SharedEvents<float>;

}  // namespace quadrille
