#include "collision/continuous/event_islands.hpp"

#include <algorithm>
#include <utility>

#include "collision/pairs/cell_walk.hpp"
#include "collision/rules/closeness.hpp"

namespace quadrille {

namespace {

/// How much of the mean one worker may have before the islands are dealt out anew, in quarters.
constexpr std::size_t unevenQuarters = 5;

/// After how many bodies a worker tells the others.
constexpr std::size_t reportEvery = 64;

}  // namespace

template <class Real>
bool EventIslands::split(const BodyView<Real>& bodies, const Neighbours& neighbours,
                         std::span<const PairEvent> events, double way) {
    if (bodies.moving.size() > rowCount_) {
        rowCount_ = std::max(bodies.moving.size(), rowCount_ + rowCount_ / 2);
        rows_ = std::make_unique<Row[]>(rowCount_);
    }
    const std::size_t most = team_.thresholds().bodiesPerEvent * events.size();
    claimedCount_.store(0, std::memory_order_relaxed);
    team_.run(team_.size(), [&](unsigned worker) {
        const std::size_t begin = events.size() * worker / team_.size();
        const std::size_t end = events.size() * (worker + 1) / team_.size();
        flood(bodies, neighbours, events.subspan(begin, end - begin), way, most,
              workers_[worker].claimed);
    });
    std::size_t claimed = 0;
    for (const Worker& worker : workers_) claimed += worker.claimed.size();
    return claimed <= most && distribute(events);
}

template <class Real>
void EventIslands::flood(const BodyView<Real>& bodies, const Neighbours& neighbours,
                         std::span<const PairEvent> events, double way, std::size_t most,
                         std::vector<std::uint32_t>& claimed) {
    const auto& m = bodies.moving;
    const auto close = [&](const auto& sizes, std::uint32_t a, std::uint32_t b) {
        return isNear<Real>(m.x[a], m.x[b], sizes.width(a), sizes.width(b), way) &&
               isNear<Real>(m.y[a], m.y[b], sizes.height(a), sizes.height(b), way);
    };
    for (const PairEvent& event : events) {
        claim(event.a, claimed);
        if (event.withStatic()) continue;
        claim(event.b.row(), claimed);
        unite(event.a, event.b.row());
    }
#if defined(__GNUC__)
    // All at once: one after the other, each would be waited for.
    for (const std::uint32_t row : claimed) {
        for (const BodyRef b : neighbours[row]) {
            if (b.isStatic()) continue;
            __builtin_prefetch(m.x.data() + b.row());
            __builtin_prefetch(m.y.data() + b.row());
        }
    }
#endif
    withSizes(bodies, [&](const auto& sizes) {
        std::size_t reported = 0;
        for (std::size_t i = 0; i < claimed.size(); ++i) {
            const std::uint32_t row = claimed[i];
            for (const BodyRef b : neighbours[row]) {
                if (b.isStatic() || !close(sizes, row, b.row())) continue;
                claim(b.row(), claimed);
                // Whoever claimed b sees this pair, too.
                if (row < b.row()) unite(row, b.row());
            }
            if (claimed.size() < reported + reportEvery) continue;
            const std::size_t news = claimed.size() - reported;
            reported = claimed.size();
            if (claimedCount_.fetch_add(news, std::memory_order_relaxed) + news > most) return;
        }
    });
}

/// Adds a body to the list of who claims it first.
void EventIslands::claim(std::uint32_t row, std::vector<std::uint32_t>& claimed) {
    if (isClaimed(row)) return;
    std::uint32_t expected = none;
    if (!rows_[row].parent.compare_exchange_strong(expected, row, std::memory_order_acq_rel)) {
        return;
    }
    rows_[row].events = 0;
    rows_[row].changed = false;
    claimed.push_back(row);
}

/// Halves the way to the root as it goes (Tarjan & van Leeuwen 1984).
std::uint32_t EventIslands::rootOf(std::uint32_t row) const {
    for (;;) {
        std::uint32_t parent = rows_[row].parent.load(std::memory_order_acquire);
        const std::uint32_t next = rows_[parent].parent.load(std::memory_order_acquire);
        if (parent == next) return parent;
        rows_[row].parent.compare_exchange_weak(parent, next, std::memory_order_acq_rel,
                                                std::memory_order_relaxed);
        row = next;
    }
}

void EventIslands::unite(std::uint32_t a, std::uint32_t b) {
    for (;;) {
        std::uint32_t low = rootOf(a);
        std::uint32_t high = rootOf(b);
        if (low == high) return;
        if (low > high) std::swap(low, high);
        std::uint32_t expected = high;
        if (rows_[high].parent.compare_exchange_strong(expected, low, std::memory_order_acq_rel)) {
            return;
        }
    }
}

/// Gives each island to the worker that met its first event, and so has its bodies in the cache; if
/// that is uneven, the island with the most events first, each to the worker that has the fewest
/// (Graham 1969). Returns whether they are spread well enough.
bool EventIslands::distribute(std::span<const PairEvent> events) {
    const std::size_t workers = workers_.size();
    islands_.clear();
    loads_.assign(workers, 0);
    for (std::size_t i = 0; i < events.size(); ++i) {
        const std::uint32_t root = rootOf(events[i].a);
        if (rows_[root].events++ == 0) {
            islands_.push_back({root, 0});
            rows_[root].worker = static_cast<std::uint16_t>(i * workers / events.size());
        }
        ++loads_[rows_[root].worker];
    }
    const auto largest = [&] { return *std::max_element(loads_.begin(), loads_.end()); };
    if (4 * workers * largest() > unevenQuarters * events.size()) {
        for (Island& island : islands_) island.events = rows_[island.root].events;
        std::sort(islands_.begin(), islands_.end(), [](const Island& p, const Island& q) {
            return p.events != q.events ? p.events > q.events : p.root < q.root;
        });
        loads_.assign(workers, 0);
        for (const Island& island : islands_) {
            const auto least = std::min_element(loads_.begin(), loads_.end());
            *least += island.events;
            rows_[island.root].worker = static_cast<std::uint16_t>(least - loads_.begin());
        }
    }
    if (4 * largest() > team_.thresholds().eventQuarters * events.size()) return false;
    for (Worker& worker : workers_) worker.events.clear();
    for (const PairEvent& event : events) {
        workers_[rows_[rootOf(event.a)].worker].events.push_back(event);
    }
    return true;
}

void EventIslands::forget(unsigned worker) {
    for (const std::uint32_t row : workers_[worker].claimed) {
        rows_[row].parent.store(none, std::memory_order_release);
    }
    workers_[worker].claimed.clear();
}

std::size_t EventIslands::bytes() const {
    std::size_t sum = rowCount_ * sizeof(Row) + islands_.capacity() * sizeof(Island) +
                      workers_.capacity() * sizeof(Worker) +
                      loads_.capacity() * sizeof(std::size_t);
    for (const Worker& worker : workers_) {
        sum += worker.claimed.capacity() * sizeof(std::uint32_t) +
               worker.events.capacity() * sizeof(PairEvent);
    }
    return sum;
}

template bool EventIslands::split(const BodyView<double>&, const Neighbours&,
                                  std::span<const PairEvent>, double);
template bool EventIslands::split(const BodyView<float>&, const Neighbours&,
                                  std::span<const PairEvent>, double);

}  // namespace quadrille
