#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/body_ref.hpp>

#include "collision/pairs/neighbours.hpp"
#include "collision/rules/event_order.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// Splits the events of a step among workers, so that no body that one of them changes can meet
/// what another one changes.
///
/// Bodies that cannot come together before the step ends, whatever happens to them, do not concern
/// each other. Islands are what is left: the bodies of the events, those close enough to be met by
/// them, those close to these, and so on. They are the components of a graph, found by
/// lock-free union and find with the lowest row as the root of each (as in Jaiganesh & Burtscher,
/// "A high-performance connected components implementation for GPUs", 2018), so they do not
/// depend on how the threads run. Each goes to one worker.
class EventIslands {
  public:
    /// `team` must outlive this.
    explicit EventIslands(const ThreadTeam& team) : team_(team), workers_(team.size()) {}

    /// Splits the events, of which all are current. Two bodies can meet if along both axes they are
    /// less than their size and `way`, in px, apart. Returns whether the split is worth it: if most
    /// events belong to one island, or the islands have too many bodies, it is not. Either way,
    /// `forget` must be called on every worker before the next split.
    template <class Real>
    bool split(const BodyView<Real>& bodies, const Neighbours& neighbours,
               std::span<const PairEvent> events, double way);

    /// The bodies that a worker claimed. Those of all workers are the bodies of all islands; which
    /// worker an island goes to is decided later.
    std::span<const std::uint32_t> claimedBy(unsigned worker) const {
        return workers_[worker].claimed;
    }

    std::span<const PairEvent> eventsOf(unsigned worker) const { return workers_[worker].events; }

    /// Whether the body may be changed by another worker; then it must not be looked at.
    bool belongsToAnother(std::uint32_t row, unsigned worker) const {
        return isClaimed(row) && rows_[rootOf(row)].worker != worker;
    }
    bool belongsTo(std::uint32_t row, unsigned worker) const {
        return isClaimed(row) && rows_[rootOf(row)].worker == worker;
    }

    /// A mark on a body of an island, until the next split.
    void markChanged(std::uint32_t row) { rows_[row].changed = true; }
    bool isChanged(std::uint32_t row) const { return rows_[row].changed; }

    /// Makes the bodies that the worker claimed ones of no island.
    void forget(unsigned worker);

    std::size_t bytes() const;

  private:
    static constexpr std::uint32_t none = BodyRef{}.bits;  // no row

    struct Row {
        std::atomic<std::uint32_t> parent{none};  // towards the root of the island; itself there
        std::uint32_t events = 0;                 // of the island, at its root
        std::uint16_t worker = 0;                 // the same
        bool changed = false;
    };
    struct Island {
        std::uint32_t root, events;
    };
    struct alignas(64) Worker {
        std::vector<std::uint32_t> claimed;  // bodies, in the order in which they were met
        std::vector<PairEvent> events;
    };

    bool isClaimed(std::uint32_t row) const {
        return rows_[row].parent.load(std::memory_order_acquire) != none;
    }
    std::uint32_t rootOf(std::uint32_t row) const;
    void unite(std::uint32_t a, std::uint32_t b);
    void claim(std::uint32_t row, std::vector<std::uint32_t>& claimed);
    template <class Real>
    void flood(const BodyView<Real>& bodies, const Neighbours& neighbours,
               std::span<const PairEvent> events, double way, std::size_t most,
               std::vector<std::uint32_t>& claimed);
    bool distribute(std::span<const PairEvent> events);

    const ThreadTeam& team_;
    std::vector<Worker> workers_;
    std::vector<Island> islands_;
    std::vector<std::size_t> loads_;  // events of each worker
    std::unique_ptr<Row[]> rows_;     // of every moving body
    std::size_t rowCount_ = 0;
    std::atomic<std::size_t> claimedCount_{0};
};

}  // namespace quadrille
