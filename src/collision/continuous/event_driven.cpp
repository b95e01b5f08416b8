#include "collision/continuous/event_driven.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include <quadrille/error.hpp>

namespace quadrille {

template <class Real, class Path>
EventDriven<Real, Path>::EventDriven(const SimulationConfig& config, const ThreadTeam& team)
    : team_(team),
      gravity_{config.gravity.x(), config.gravity.y()},
      restitution_(config.restitution),
      candidates_(team),
      found_(team.size()) {
    if (!falls && restitution_ == 1 && team.size() > 1) {
        shared_ = std::make_unique<SharedEvents<Real>>(team);
    }
}

template <class Real, class Path>
void EventDriven<Real, Path>::anchor(const BodyView<Real>& bodies, double now) {
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
        events_.queue.clear();
        horizon_ = -1;
        surveyed_ = false;
        stamps_.assign(rows, 0);
        if constexpr (!falls) anchors.rests = {};
        while (anchors.rests.size() < rows) anchors.rests.push_back(0);
    }
    auto& changed = events_.changed;
    if (anchors.incomplete) {
        for (std::uint32_t i = 0; i < rows; ++i) {
            if (!std::isnan(anchors.rows[i].timeX)) continue;
            anchors.rows[i] = {m.x[i], m.y[i], m.vx[i], m.vy[i], now, now};
            if (!edited) changed.push_back(i);
        }
        anchors.incomplete = false;
    }
    if (edited) {
        changed.resize(rows);
        for (std::uint32_t i = 0; i < rows; ++i) changed[i] = i;
    }
}

template <class Real, class Path>
bool EventDriven<Real, Path>::place(const BodyView<Real>& bodies, double t) const {
    const auto& m = bodies.moving;
    const Trajectories<Real, Path> motion(bodies, gravity_);
    constexpr Real largest = std::numeric_limits<Real>::max();
    return !team_.any(m.size(), worthwhile::streamed, [&](std::size_t begin, std::size_t end) {
        const Anchor<Real>* const rows = m.anchors->rows.data();
        Real* const x = m.x.data();
        Real* const y = m.y.data();
        int lost = 0;
        for (std::size_t i = begin; i < end; ++i) {
            if constexpr (falls) {
                const auto at = motion.paths(static_cast<std::uint32_t>(i));
                x[i] = static_cast<Real>(at.along[0].position(t));
                y[i] = static_cast<Real>(at.along[1].position(t));
                m.vx[i] = static_cast<Real>(at.along[0].speed(t));
                m.vy[i] = static_cast<Real>(at.along[1].speed(t));
            } else {
                const Anchor<Real>& a = rows[i];
                x[i] = static_cast<Real>(static_cast<double>(a.x) + a.vx * (t - a.timeX));
                y[i] = static_cast<Real>(static_cast<double>(a.y) + a.vy * (t - a.timeY));
            }
            lost |= !(std::abs(x[i]) <= largest) | !(std::abs(y[i]) <= largest);
        }
        return lost != 0;
    });
}

/// Looks at the speeds and positions of all bodies, at a time when they are up to date.
template <class Real, class Path>
void EventDriven<Real, Path>::survey(const BodyView<Real>& bodies) {
    const auto largest = [&](std::span<const Real> along, std::span<const Real> across) {
        return static_cast<double>(team_.template maximum<Real>(
            along.size(), worthwhile::streamed, [&](std::size_t begin, std::size_t end) {
                Real most = 0;
#pragma omp simd reduction(max : most)
                for (std::size_t i = begin; i < end; ++i) {
                    const Real x = std::abs(along[i]);
                    const Real y = std::abs(across[i]);
                    const Real larger = x > y ? x : y;
                    most = larger > most ? larger : most;
                }
                return most;
            }));
    };
    fastest_ = largest(bodies.moving.vx, bodies.moving.vy);
    farthest_ = largest(bodies.moving.x, bodies.moving.y);
    surveyed_ = true;
}

template <class Real, class Path>
Real EventDriven<Real, Path>::reach(const BodyView<Real>& bodies, double from, double to) {
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

/// All meetings of candidates between `from` and `to`.
template <class Real, class Path>
void EventDriven<Real, Path>::findAll(const Search& search, double from, double to) {
    const unsigned workers = team_.workersFor(candidates_.size(), worthwhile::tested);
    const auto findShare = [&](unsigned worker, EventQueue& queue) {
        const auto find = [&](auto pairs) { search.findAmong(pairs, from, to, queue); };
        candidates_.forShare(worker, workers, find, find);
    };
    if (workers == 1) {
        findShare(0, events_.queue);
        return;
    }
    team_.run(workers, [&](unsigned worker) {
        found_[worker].events.beginShare(events_.queue, {});
        findShare(worker, found_[worker].events);
    });
    for (Found& found : found_) events_.queue.take(found.events);
}

template <class Real, class Path>
double EventDriven<Real, Path>::advance(const BodyView<Real>& bodies,
                                        const Partition<Real>& partition, Real reach, double from,
                                        double to, std::vector<ContactRecord>* records,
                                        ResolveCounts& counts) {
    events_.queue.begin(to, bodies.moving.entity, bodies.fixed.entity);
    const bool newPairs = candidates_.update(bodies, partition);
    if (newPairs) surveyed_ = false;  // speeds may have fallen
    if (newPairs) neighbours_.link(bodies.moving.size(), candidates_);

    const Trajectories<Real, Path> motion(bodies, gravity_);
    const Search search(motion, neighbours_, stamps_, restitution_);
    if (newPairs || to > horizon_) {
        // Meetings do not depend on steps, so they are found for as long as the pairs may last.
        const double life = reach > 0 ? static_cast<double>(partition.margin / reach) + 1 : 1.0;
        horizon_ = std::max(to, from + life * (to - from));
        findAll(search, from, horizon_);
        counts.pairsTested += candidates_.size();
    }

    using Loop = EventLoop<Real, Path>;
    const EventWindow<Real> window{.to = to, .horizon = horizon_, .reach = reach};
    Loop loop(search, events_, window);
    const auto neighboursOf = [&](std::uint32_t row) { return neighbours_[row]; };
    if constexpr (falls) loop.releaseFromChanged(from);
    loop.findForChanged(from, neighboursOf);
    events_.fastest = 0;
    if (runShared(search, window, records, counts)) return to;
    loop.prefetch();
    const std::uint64_t most =
        counts.contacts + Loop::mostEventsPerBody * (bodies.moving.size() + 1);
    const auto count = [&](const PairEvent&) {
        if (++counts.contacts > most) {
            throw Error("the law 'continuous' found more than " +
                        std::to_string(Loop::mostEventsPerBody) + " events per body in a step");
        }
        return true;
    };
    const auto collided = [&](const PairEvent&, const ContactRecord& record) {
        ++counts.collisions;
        if (records != nullptr) records->push_back(record);
    };
    const bool complete = loop.run(count, collided, neighboursOf);
    fastest_ = std::max(fastest_, events_.fastest);
    // Where it is not, the caller makes a partition that covers the new speed, and the search goes
    // on there.
    return complete ? to : loop.stoppedAt();
}

template <class Real, class Path>
bool EventDriven<Real, Path>::runShared(const Search& search, const EventWindow<Real>& window,
                                        std::vector<ContactRecord>* records,
                                        ResolveCounts& counts) {
    if constexpr (!falls) {
        // Both bodies move by `reach` at most; rounding grows with how far anchors lie away, which
        // is up to how far a body came in the run.
        constexpr double eps = 64 * static_cast<double>(std::numeric_limits<Real>::epsilon());
        const double way = 2 * static_cast<double>(window.reach) +
                           eps * (farthest_ + fastest_ * std::abs(window.to));
        if (!shared_ || !shared_->run(search, events_, window, way, records, counts)) return false;
        fastest_ = std::max(fastest_, events_.fastest);
        return true;
    }
    return false;
}

template <class Real, class Path>
std::size_t EventDriven<Real, Path>::bytes() const {
    std::size_t sum = candidates_.bytes() + neighbours_.bytes() + events_.bytes() +
                      stamps_.capacity() * sizeof(std::uint32_t) +
                      found_.capacity() * sizeof(Found);
    for (const Found& found : found_) sum += found.events.bytes();
    return shared_ ? sum + shared_->bytes() : sum;
}

template <class Real>
std::unique_ptr<ContinuousLaw<Real>> makeContinuousLaw(const SimulationConfig& config,
                                                       const ThreadTeam& team) {
    if (config.resolver != ResolverKind::Sequential && config.resolver != ResolverKind::Threads) {
        throw NotAvailable("the law 'continuous' does not run on the resolver '" +
                           std::string(name(config.resolver)) + "'");
    }
    if (config.gravity == Vec2(0, 0)) {
        return std::make_unique<EventDriven<Real, StraightPath>>(config, team);
    }
    return std::make_unique<EventDriven<Real, FallingPath>>(config, team);
}

template std::unique_ptr<ContinuousLaw<double>> makeContinuousLaw(const SimulationConfig&,
                                                                  const ThreadTeam&);
template std::unique_ptr<ContinuousLaw<float>> makeContinuousLaw(const SimulationConfig&,
                                                                 const ThreadTeam&);

}  // namespace quadrille
