#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <quadrille/bodies.hpp>

#include "collision/pairs/narrow_phase.hpp"
#include "collision/pairs/threads_candidate_pairs.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// NarrowPhase on several threads. Which worker finds a pair depends on the sizes of the cells and
/// not on time, so that the workers' buffers stop growing as those of one thread do.
template <class Real>
class ThreadsNarrowPhase {
  public:
    explicit ThreadsNarrowPhase(const ThreadTeam& team)
        : team_(team), candidates_(team), workers_(team.size()) {}

    /// As NarrowPhase::find, with calls of `onMoving(worker, MovingPair)` and `onStatic(worker,
    /// StaticPair)` on all workers at the same time.
    template <class OnMoving, class OnStatic>
    std::uint64_t find(const BodyView<Real>& bodies, const Partition<Real>& partition,
                       OnMoving&& onMoving, OnStatic&& onStatic) {
        return withSizes(bodies, [&](const auto& sizes) -> std::uint64_t {
            if (!(partition.margin > 0)) {
                return walkCells(bodies, partition, sizes, onMoving, onStatic);
            }
            candidates_.update(bodies, partition);
            return testCandidates(bodies, sizes, onMoving, onStatic);
        });
    }

    std::size_t bytes() const {
        std::size_t sum = candidates_.bytes() + workers_.capacity() * sizeof(Worker);
        for (const Worker& w : workers_) sum += w.walk.bytes();
        return sum;
    }

  private:
    struct alignas(64) Worker {
        CellWalk<Real> walk;
        std::uint64_t tested = 0;
        std::size_t hits = 0;
    };

    template <class Sizes, class OnMoving, class OnStatic>
    std::uint64_t walkCells(const BodyView<Real>& bodies, const Partition<Real>& partition,
                            const Sizes& sizes, OnMoving& onMoving, OnStatic& onStatic) {
        const unsigned workers = team_.workersFor(bodies.size(), &Thresholds::walked);
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

    template <class Sizes, class OnMoving, class OnStatic>
    std::uint64_t testCandidates(const BodyView<Real>& bodies, const Sizes& sizes,
                                 OnMoving& onMoving, OnStatic& onStatic) {
        const unsigned workers =
            team_.workersFor(candidates_.size() + hitPrice * lastHits_, &Thresholds::tested);
        team_.run(workers, [&](unsigned worker) {
            std::size_t hits = 0;
            candidates_.forShare(
                worker, workers,
                [&](std::span<const MovingPair> pairs) {
                    testMoving(bodies, sizes, pairs, [&](MovingPair p) {
                        ++hits;
                        onMoving(worker, p);
                    });
                },
                [&](std::span<const StaticPair> pairs) {
                    testStatic(bodies, sizes, pairs, [&](StaticPair p) { onStatic(worker, p); });
                });
            workers_[worker].hits = hits;
        });
        lastHits_ = 0;
        for (unsigned w = 0; w < workers; ++w) lastHits_ += workers_[w].hits;
        return candidates_.size();
    }

    /// What a pair costs that overlaps, in pairs that do not.
    static constexpr std::size_t hitPrice = 30;

    const ThreadTeam& team_;
    ThreadsCandidatePairs<Real> candidates_;
    std::vector<Worker> workers_;
    std::size_t lastHits_ = 0;  // pairs that overlapped in the last step
};

}  // namespace quadrille
