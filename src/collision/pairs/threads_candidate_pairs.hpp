#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <quadrille/bodies.hpp>

#include "collision/broad/partitioner.hpp"
#include "collision/pairs/candidate_pairs.hpp"
#include "parallel/thread_team.hpp"

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

/// CandidatePairs on several threads: a list for each, from its share of the cells. Which worker
/// finds a pair depends on the sizes of the cells and not on time.
template <class Real>
class ThreadsCandidatePairs {
  public:
    /// `team` must outlive this.
    explicit ThreadsCandidatePairs(const ThreadTeam& team) : team_(team), lists_(team.size()) {}

    /// Collects the pairs anew if the partition was built since the last call. Returns whether it
    /// did.
    bool update(const BodyView<Real>& bodies, const Partition<Real>& partition) {
        if (collected_ == partition.generation) return false;
        const Real inflation = CandidatePairs<Real>::inflationOf(bodies, partition, team_);
        for (List& list : lists_) list.pairs.clear();
        const unsigned workers = team_.workersFor(bodies.size(), &Thresholds::walked);
        team_.run(workers, [&](unsigned worker) {
            const auto [first, last] = shareOfCells(partition.cells, worker, workers);
            lists_[worker].pairs.add(bodies, partition, inflation, first, last);
        });
        movingCount_ = fixedCount_ = 0;
        for (const List& list : lists_) {
            movingCount_ += list.pairs.moving().size();
            fixedCount_ += list.pairs.fixed().size();
        }
        collected_ = partition.generation;
        return true;
    }

    std::size_t size() const { return movingCount_ + fixedCount_; }

    /// Calls `onMoving(span)` and `onFixed(span)` for the share of one worker of all lists, part by
    /// part.
    template <class OnMoving, class OnFixed>
    void forShare(unsigned worker, unsigned workers, OnMoving&& onMoving, OnFixed&& onFixed) const {
        forRange(
            movingCount_ * worker / workers, movingCount_ * (worker + 1) / workers,
            [](const List& list) { return list.pairs.moving(); }, onMoving);
        forRange(
            fixedCount_ * worker / workers, fixedCount_ * (worker + 1) / workers,
            [](const List& list) { return list.pairs.fixed(); }, onFixed);
    }

    std::size_t bytes() const {
        std::size_t sum = lists_.capacity() * sizeof(List);
        for (const List& list : lists_) sum += list.pairs.bytes();
        return sum;
    }

  private:
    struct alignas(64) List {
        CandidatePairs<Real> pairs;
    };

    /// Calls `function(span)` for the pairs from `begin` to `end` of all lists, taken as one.
    template <class PairsOf, class Function>
    void forRange(std::size_t begin, std::size_t end, PairsOf&& pairsOf,
                  Function&& function) const {
        std::size_t start = 0;  // of the list in the long one
        for (const List& list : lists_) {
            const auto pairs = pairsOf(list);
            const std::size_t from = std::clamp(begin, start, start + pairs.size());
            const std::size_t to = std::clamp(end, start, start + pairs.size());
            if (from < to) function(pairs.subspan(from - start, to - from));
            start += pairs.size();
        }
    }

    const ThreadTeam& team_;
    std::vector<List> lists_;
    std::size_t movingCount_ = 0, fixedCount_ = 0;
    std::uint64_t collected_ = 0;  // generation of the partition that the pairs come from
};

}  // namespace quadrille
