#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace quadrille {

/// From how many items on a loop is worth handing out: about 20 us of work for one thread, several
/// times what it costs to start and end a parallel loop (docs/performance.md). What is split in
/// other ways has its limits here, too. Nothing here changes a result.
struct Thresholds {
    std::size_t streamed = 20'000;  ///< bodies that are read and written in passing
    std::size_t tested = 16'000;    ///< pairs whose boxes are compared
    std::size_t built = 4'000;      ///< bodies that cells are made for
    std::size_t walked = 1'500;     ///< bodies whose cells are walked through
    std::size_t resolved = 300;     ///< contacts
    std::size_t linked = 1'200;     ///< contacts that are linked to a graph
    std::size_t scattered = 500;    ///< bodies that are written here and there
    std::size_t copied = 200'000;   ///< bytes
    std::size_t events = 200;       ///< events of a step of an exact law, 0.4 us each

    /// Threads from which on a graph of contacts gains something: it costs about three times what
    /// it costs one thread to resolve the same contacts.
    unsigned graphThreads = 5;
    /// Threads from which on events gain from being shared out where bodies can heap up: under
    /// gravity, or with restitution below 1. Two lose by it.
    unsigned heapThreads = 4;
    /// References in a part of a tree at the most: as many as a thread builds in its cache.
    std::size_t treePart = 1024;
    /// Bodies in islands for each event: to claim so many costs a little more than to carry out the
    /// event.
    std::size_t bodiesPerEvent = 8;
    /// The part of the events that one worker may have, in quarters.
    std::size_t eventQuarters = 3;
    /// Steps without a try after one that was not worth it, at most.
    unsigned longestPause = 64;

    /// Shares out even the smallest loops, so that small tests reach that code.
    static Thresholds none() {
        return {.streamed = 0,
                .tested = 0,
                .built = 0,
                .walked = 0,
                .resolved = 0,
                .linked = 0,
                .scattered = 0,
                .copied = 0,
                .events = 0,
                .graphThreads = 0,
                .heapThreads = 0,
                .treePart = 1,
                .bodiesPerEvent = std::size_t(1) << 31,
                .eventQuarters = 4,
                .longestPause = 0};
    }
};

/// Threads that share out the loops of a step. docs/decisions.md tells why not by OpenMP.
///
/// A loop is cut into workers, several to a thread: a thread that gets less of its core than the
/// others leaves them some of its workers.
class ThreadTeam {
  public:
    /// Throws std::system_error if the system does not start so many.
    explicit ThreadTeam(unsigned threads = 1, const Thresholds& thresholds = {});
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    /// One thread, the caller's.
    static const ThreadTeam& serial();

    /// Cores that this process may use, at least 1.
    static unsigned cores();

    unsigned threads() const { return threads_; }
    /// Workers that a loop is cut into; 1 if there is one thread.
    unsigned size() const { return threads_ == 1 ? 1 : threads_ * workersPerThread; }
    const Thresholds& thresholds() const { return thresholds_; }

    /// A number of items, or the name of one in the thresholds.
    struct Least {
        std::size_t Thresholds::*named = nullptr;
        std::size_t number = 0;

        Least(std::size_t Thresholds::*name) : named(name) {}
        Least(std::size_t items) : number(items) {}
    };

    /// The workers for a loop of `count` items that pays off from `least` items on: all or one.
    unsigned workersFor(std::size_t count, Least least) const {
        const std::size_t items = least.named != nullptr ? thresholds_.*least.named : least.number;
        return count >= items ? size() : 1;
    }

    /// Calls `function(worker)` once for every worker below `workers`, which is what workersFor
    /// gave, at the same time if the machine permits; so none may wait for another. Returns when
    /// all are done, and throws what one of them threw. `function` may not run loops of its own on
    /// the team, and only one thread may use the team at a time.
    template <class Function>
    void run(unsigned workers, Function&& function) const {
        if (workers <= 1) {
            function(0u);
            return;
        }
        using Plain = std::remove_reference_t<Function>;
        fork([](const void* f,
                unsigned worker) { (*const_cast<Plain*>(static_cast<const Plain*>(f)))(worker); },
             std::addressof(function));
    }

    /// Calls `function(begin, end, worker)` for one contiguous share of 0..count a worker.
    template <class Function>
    void shares(std::size_t count, Least least, Function&& function) const {
        const unsigned workers = workersFor(count, least);
        run(workers, [&](unsigned worker) {
            function(count * worker / workers, count * (worker + 1) / workers, worker);
        });
    }

    /// Calls `function(begin, end, worker)` for blocks of `block` items, each taken by the next
    /// worker that is free; for items of unequal cost.
    template <class Function>
    void blocks(unsigned workers, std::size_t count, std::size_t block, Function&& function) const {
        if (workers <= 1) {
            if (count > 0) function(std::size_t(0), count, 0u);
            return;
        }
        std::atomic<std::size_t> next{0};
        run(workers, [&](unsigned worker) {
            for (std::size_t begin;
                 (begin = next.fetch_add(block, std::memory_order_relaxed)) < count;) {
                function(begin, std::min(count, begin + block), worker);
            }
        });
    }

    /// Whether `function(begin, end)` holds for a part of 0..count.
    template <class Function>
    bool any(std::size_t count, Least least, Function&& function) const {
        std::atomic<bool> found{false};
        shares(count, least, [&](std::size_t begin, std::size_t end, unsigned) {
            if (function(begin, end)) found.store(true, std::memory_order_relaxed);
        });
        return found;
    }

    /// The largest `function(begin, end)` over parts of 0..count, at least 0.
    template <class Real, class Function>
    Real maximum(std::size_t count, Least least, Function&& function) const {
        std::atomic<Real> most{0};
        shares(count, least, [&](std::size_t begin, std::size_t end, unsigned) {
            const Real value = function(begin, end);
            Real seen = most.load(std::memory_order_relaxed);
            while (value > seen && !most.compare_exchange_weak(seen, value)) {
            }
        });
        return most;
    }

    /// The sum of `function(begin, end)` over parts of 0..count. The parts do not depend on the
    /// number of threads, so that the sum has the same bits for any.
    template <class Function>
    double sum(std::size_t count, Least least, Function&& function) const {
        constexpr std::size_t parts = 256;
        std::array<double, parts> partial{};
        const auto start = [&](std::size_t part) { return count * part / parts; };
        blocks(workersFor(count, least), parts, 4, [&](std::size_t b, std::size_t e, unsigned) {
            for (std::size_t p = b; p < e; ++p) partial[p] = function(start(p), start(p + 1));
        });
        double total = 0;
        for (const double value : partial) total += value;
        return total;
    }

  private:
    struct Shared;
    static constexpr unsigned workersPerThread = 4;

    void fork(void (*call)(const void*, unsigned), const void* context) const;

    unsigned threads_;
    Thresholds thresholds_;
    std::unique_ptr<Shared> shared_;  // null for one thread
};

}  // namespace quadrille
