#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "reference/cell_grid.hpp"
#include "reference/oracle.hpp"

namespace quadrille::reference {

/// The moving boxes that may touch one, in the order of ids.
using Near = std::function<std::vector<std::int64_t>(std::int64_t)>;

/// A collision to come.
template <class Time>
struct Hit {
    Time time;
    int axis;  ///< 1 = x, 2 = y, 3 = both
};

/// The next border that the centre of a box passes.
template <class Time>
struct Crossing {
    Time time;
    int axis;  ///< 1 = x, 2 = y
    int side;  ///< +1 or -1: towards greater or lesser coordinates
};

/// Fires the events of a model in time order, ties by kind, then by ids. A model knows the
/// trajectories; it has
///
///     Time                                         ordered by <
///     std::int64_t movingCount(), staticCount()
///     Cell cellAtStart(i)
///     std::uint32_t priority(i, j)                 of collisions at one instant, the lowest first
///     std::optional<Hit<Time>> hit(i, j, now)      the next collision from `now` on; j < 0: static
///     std::optional<Crossing<Time>> crossing(i, cell, now)
///     std::optional<Time> release(i, now)          when a resting box slides off its support
///     bool collide(i, j, axis, now, near, changed) true if it counts as a collision; appends the
///     void letGo(i, now, changed)                  boxes whose trajectory is a new one
///     double seconds(time)
///
/// `near(i)` gives the moving boxes that may touch i, itself included, in the order of ids.
///
/// Queued events name the trajectories that they were computed from by a version; events of
/// trajectories that have changed since are dropped when they come up.
template <class Model>
class Scheduler {
  public:
    using Time = typename Model::Time;

    Scheduler(Model& model, const Time& start)
        : model_(model), now_(start), versions_(std::size_t(model.movingCount()), 0) {
        for (std::int64_t i = 0; i < model_.movingCount(); ++i) {
            cells_.push_back(model_.cellAtStart(i));
            grid_.insert(i, cells_.back());
        }
        for (std::int64_t i = 0; i < model_.movingCount(); ++i) predict(i, i);
    }

    /// Fires all events up to `limit`, those at `limit` included.
    void runUntil(const Time& limit) {
        while (!queue_.empty() && !(limit < queue_.top().time)) {
            const Entry entry = queue_.top();
            queue_.pop();
            if (!stale(entry)) fire(entry);
        }
        now_ = limit;
    }

    const std::vector<Event>& events() const { return events_; }

  private:
    enum class Kind { Collision, Release, Crossing };

    struct Entry {
        Time time;
        Kind kind;
        std::int64_t i;
        std::int64_t j;  // the other box; the side of a crossing
        int axis;
        std::uint32_t versionI;
        std::uint32_t versionJ;
        std::uint32_t priority = 0;  // of a collision: the lower, the earlier

        // The queue has the greatest on top.
        bool operator<(const Entry& other) const {
            if (other.time < time) return true;
            if (time < other.time) return false;
            return std::tie(other.kind, other.priority, other.i, other.j, other.axis) <
                   std::tie(kind, priority, i, j, axis);
        }
    };

    /// More events than this at one instant are taken for an endless series. A row of N touching
    /// boxes needs up to N (N - 1) / 2.
    std::size_t eventsAtOneInstant() const { return versions_.size() * (versions_.size() + 1000); }

    std::uint32_t version(std::int64_t body) const {
        return body < 0 ? 0 : versions_[std::size_t(body)];
    }
    bool stale(const Entry& entry) const {
        if (version(entry.i) != entry.versionI) return true;
        return entry.kind == Kind::Collision && version(entry.j) != entry.versionJ;
    }

    void fire(const Entry& entry) {
        sameInstant_ = now_ < entry.time ? 0 : sameInstant_ + 1;
        if (sameInstant_ > eventsAtOneInstant()) {
            throw std::runtime_error("the events at one instant do not end");
        }
        now_ = entry.time;
        changed_.clear();
        switch (entry.kind) {
            case Kind::Collision:
                if (model_.collide(
                        entry.i, entry.j, entry.axis, now_,
                        [this](std::int64_t i) { return near(i); }, changed_)) {
                    events_.push_back({model_.seconds(now_), entry.i, entry.j, entry.axis});
                }
                break;
            case Kind::Release:
                model_.letGo(entry.i, now_, changed_);
                break;
            case Kind::Crossing:
                cross(entry);
                return;
        }
        for (const std::int64_t body : changed_) ++versions_[std::size_t(body)];
        for (const std::int64_t body : changed_) predict(body, -1);
    }

    std::vector<std::int64_t> near(std::int64_t i) const {
        const Cell& cell = cells_[std::size_t(i)];
        std::vector<std::int64_t> bodies;
        grid_.each({cell.x - 1, cell.y - 1}, {cell.x + 1, cell.y + 1},
                   [&](std::int64_t other) { bodies.push_back(other); });
        std::sort(bodies.begin(), bodies.end());
        return bodies;
    }

    /// Moves a box to the next cell and meets the boxes of the three cells that come near.
    void cross(const Entry& entry) {
        Cell& cell = cells_[std::size_t(entry.i)];
        grid_.erase(entry.i, cell);
        (entry.axis == 1 ? cell.x : cell.y) += entry.j;
        grid_.insert(entry.i, cell);
        Cell low{cell.x - 1, cell.y - 1};
        Cell high{cell.x + 1, cell.y + 1};
        if (entry.axis == 1) {
            low.x = high.x = cell.x + entry.j;
        } else {
            low.y = high.y = cell.y + entry.j;
        }
        grid_.each(low, high, [&](std::int64_t other) { predictPair(entry.i, other); });
        predictCrossing(entry.i);
    }

    /// Queues all events of a box, with those others only whose id is greater than `above`.
    void predict(std::int64_t i, std::int64_t above) {
        const Cell& cell = cells_[std::size_t(i)];
        grid_.each({cell.x - 1, cell.y - 1}, {cell.x + 1, cell.y + 1}, [&](std::int64_t other) {
            if (other > above && other != i) predictPair(i, other);
        });
        for (std::int64_t k = 0; k < model_.staticCount(); ++k) predictPair(i, -1 - k);
        if (const auto time = model_.release(i, now_)) {
            queue_.push({*time, Kind::Release, i, 0, 0, version(i), 0});
        }
        predictCrossing(i);
    }

    void predictPair(std::int64_t a, std::int64_t b) {
        const std::int64_t i = b < 0 ? a : std::min(a, b);
        const std::int64_t j = b < 0 ? b : std::max(a, b);
        if (const auto hit = model_.hit(i, j, now_)) {
            queue_.push({hit->time, Kind::Collision, i, j, hit->axis, version(i), version(j),
                         model_.priority(i, j)});
        }
    }

    void predictCrossing(std::int64_t i) {
        if (const auto next = model_.crossing(i, cells_[std::size_t(i)], now_)) {
            queue_.push({next->time, Kind::Crossing, i, next->side, next->axis, version(i), 0});
        }
    }

    Model& model_;
    Time now_;
    std::vector<std::uint32_t> versions_;  // of the trajectories
    std::vector<Cell> cells_;
    CellGrid grid_;
    std::priority_queue<Entry> queue_;
    std::vector<Event> events_;
    std::vector<std::int64_t> changed_;
    std::size_t sameInstant_ = 0;
};

}  // namespace quadrille::reference
