#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <quadrille/bodies.hpp>

#include "collision/narrow_phase.hpp"
#include "collision/thread_team.hpp"

namespace quadrille {

/// The cells from the first to the last of one worker; all workers have about as many entries.
inline std::pair<std::size_t, std::size_t> shareOfCells(const Cells& cells, unsigned worker,
                                                        unsigned workers) {
    const auto border = [&](unsigned w) -> std::size_t {
        if (w == workers) return cells.size();
        const std::size_t entry = cells.bodies.size() * w / workers;
        const auto first = cells.offsets.begin();
        return std::min<std::size_t>(cells.size(),
                                     std::lower_bound(first, cells.offsets.end(), entry) - first);
    };
    return {border(worker), border(worker + 1)};
}

/// NarrowPhase on several threads. Which worker finds a pair depends on the sizes of the cells and
/// not on time, so that the workers' buffers stop growing as those of one thread do.
template <class Real>
class ThreadsNarrowPhase {
  public:
    explicit ThreadsNarrowPhase(const ThreadTeam& team) : team_(team), workers_(team.size()) {}

    /// As NarrowPhase::find, with calls of `onMoving(worker, MovingPair)` and `onStatic(worker,
    /// StaticPair)` on all workers at the same time.
    template <class OnMoving, class OnStatic>
    std::uint64_t find(const BodyView<Real>& bodies, const Partition<Real>& partition,
                       OnMoving&& onMoving, OnStatic&& onStatic) {
        return withSizes(bodies, [&](const auto& sizes) -> std::uint64_t {
            if (!(partition.margin > 0)) {
                return walkCells(bodies, partition, sizes, onMoving, onStatic);
            }
            collect(bodies, partition);
            return testCandidates(bodies, sizes, onMoving, onStatic);
        });
    }

    std::size_t bytes() const {
        std::size_t sum = workers_.capacity() * sizeof(Worker);
        for (const Worker& w : workers_) sum += w.walk.bytes() + w.candidates.bytes();
        return sum;
    }

  private:
    struct alignas(64) Worker {
        CellWalk<Real> walk;
        CandidatePairs<Real> candidates;
        std::uint64_t tested = 0;
        std::size_t hits = 0;
    };

    template <class Sizes, class OnMoving, class OnStatic>
    std::uint64_t walkCells(const BodyView<Real>& bodies, const Partition<Real>& partition,
                            const Sizes& sizes, OnMoving& onMoving, OnStatic& onStatic) {
        const unsigned workers = team_.workersFor(bodies.size(), worthwhile::walked);
        team_.run(workers, [&](unsigned worker) {
            const auto [first, last] = shareOfCells(partition.cells, worker, workers);
            const auto moving = [&](MovingPair p) { onMoving(worker, p); };
            workers_[worker].tested = workers_[worker].walk.walk(
                bodies, partition, sizes, Real(0), first, last, asPairs(moving),
                [&](StaticPair p) { onStatic(worker, p); });
        });
        std::uint64_t tested = 0;
        for (unsigned w = 0; w < workers; ++w) tested += workers_[w].tested;
        return tested;
    }

    void collect(const BodyView<Real>& bodies, const Partition<Real>& partition) {
        if (collected_ == partition.generation) return;
        const Real inflation = CandidatePairs<Real>::inflationOf(bodies, partition, team_);
        for (Worker& w : workers_) w.candidates.clear();
        const unsigned workers = team_.workersFor(bodies.size(), worthwhile::walked);
        team_.run(workers, [&](unsigned worker) {
            const auto [first, last] = shareOfCells(partition.cells, worker, workers);
            workers_[worker].candidates.add(bodies, partition, inflation, first, last);
        });
        collected_ = partition.generation;
    }

    template <class Sizes, class OnMoving, class OnStatic>
    std::uint64_t testCandidates(const BodyView<Real>& bodies, const Sizes& sizes,
                                 OnMoving& onMoving, OnStatic& onStatic) {
        std::size_t moving = 0;
        std::size_t fixed = 0;
        for (const Worker& w : workers_) {
            moving += w.candidates.moving().size();
            fixed += w.candidates.fixed().size();
        }
        const unsigned workers =
            team_.workersFor(moving + fixed + hitPrice * lastHits_, worthwhile::tested);
        team_.run(workers, [&](unsigned worker) {
            std::size_t hits = 0;
            forShare(
                moving * worker / workers, moving * (worker + 1) / workers,
                [](const Worker& w) { return w.candidates.moving(); },
                [&](std::span<const MovingPair> pairs) {
                    testMoving(bodies, sizes, pairs, [&](MovingPair p) {
                        ++hits;
                        onMoving(worker, p);
                    });
                });
            forShare(
                fixed * worker / workers, fixed * (worker + 1) / workers,
                [](const Worker& w) { return w.candidates.fixed(); },
                [&](std::span<const StaticPair> pairs) {
                    testStatic(bodies, sizes, pairs, [&](StaticPair p) { onStatic(worker, p); });
                });
            workers_[worker].hits = hits;
        });
        lastHits_ = 0;
        for (unsigned w = 0; w < workers; ++w) lastHits_ += workers_[w].hits;
        return moving + fixed;
    }

    /// Calls `function(span)` for what lies from `begin` to `end` in the workers' lists, taken as
    /// one long list.
    template <class ListOf, class Function>
    void forShare(std::size_t begin, std::size_t end, ListOf&& listOf, Function&& function) const {
        std::size_t start = 0;  // of the list in the long one
        for (const Worker& w : workers_) {
            const auto list = listOf(w);
            const std::size_t from = std::clamp(begin, start, start + list.size());
            const std::size_t to = std::clamp(end, start, start + list.size());
            if (from < to) function(list.subspan(from - start, to - from));
            start += list.size();
        }
    }

    /// What a pair costs that overlaps, in pairs that do not.
    static constexpr std::size_t hitPrice = 30;

    const ThreadTeam& team_;
    std::vector<Worker> workers_;
    std::size_t lastHits_ = 0;     // pairs that overlapped in the last step
    std::uint64_t collected_ = 0;  // generation of the partition that the candidates come from
};

}  // namespace quadrille
