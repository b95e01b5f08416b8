#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "collision/broad/extents.hpp"
#include "collision/broad/partitioner.hpp"
#include "collision/pairs/cell_walk.hpp"
#include "collision/rules/mix64.hpp"
#include "collision/rules/pair_contact.hpp"

namespace quadrille {

/// Overlapping pairs, and those of them that a partition does not show.
struct PairAudit {
    std::uint64_t overlapping = 0;
    std::uint64_t missed = 0;
};

/// Holds a partition against all overlapping pairs. These are found without any cells: bodies are
/// sorted by x, and all are compared whose x is close enough (sort and sweep), so that no mistake
/// of a partitioner can hide in both.
template <class Real>
class MissedPairCounter {
  public:
    /// Audits one step in `every`.
    explicit MissedPairCounter(std::uint64_t every) : every_(every) {}

    /// Whether a step is one of the sample: the first that is asked about, then those that a hash
    /// of the number picks. A fixed stride could keep time with a policy that rebuilds every so
    /// many steps, and see nothing but fresh trees.
    bool picks(std::uint64_t step) {
        const bool picked = !started_ || every_ <= 1 || mix64(step) % every_ == 0;
        started_ = true;
        return picked;
    }

    /// Pairs of which at least one body moves and whose boxes overlap, or would if both moved up to
    /// `reach` px.
    PairAudit count(const BodyView<Real>& bodies, const Partition<Real>& partition, Real reach) {
        collectOverlapping(bodies, 2 * reach);
        collectShown(bodies, partition, 2 * reach);
        PairAudit audit{.overlapping = overlapping_.size()};
        auto shown = shown_.begin();
        for (const Pair& pair : overlapping_) {
            while (shown != shown_.end() && *shown < pair) ++shown;
            audit.missed += shown == shown_.end() || *shown != pair;
        }
        return audit;
    }

  private:
    using Pair = std::pair<std::uint32_t, std::uint32_t>;  // static bodies after the moving ones

    void collectOverlapping(const BodyView<Real>& bodies, Real inflation) {
        const auto& m = bodies.moving;
        const auto& f = bodies.fixed;
        const auto count = static_cast<std::uint32_t>(m.size());
        order_.resize(count);
        std::iota(order_.begin(), order_.end(), 0u);
        std::sort(order_.begin(), order_.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return m.x[a] < m.x[b]; });
        Real widestMoving = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            widestMoving = std::max(widestMoving, m.halfWidth[i]);
        }

        overlapping_.clear();
        for (std::size_t p = 0; p < count; ++p) {
            const std::uint32_t a = order_[p];
            const Real width = m.halfWidth[a] + inflation;
            const Real height = m.halfHeight[a] + inflation;
            for (std::size_t q = p + 1; q < count; ++q) {
                const std::uint32_t b = order_[q];
                const Real dx = m.x[b] - m.x[a];
                if (!(dx < width + widestMoving)) break;
                if (overlaps(dx, m.y[b] - m.y[a], width + m.halfWidth[b],
                             height + m.halfHeight[b])) {
                    overlapping_.emplace_back(std::min(a, b), std::max(a, b));
                }
            }
            for (std::uint32_t k = 0; k < f.size(); ++k) {
                if (overlaps(f.x[k] - m.x[a], f.y[k] - m.y[a], width + f.halfWidth[k],
                             height + f.halfHeight[k])) {
                    overlapping_.emplace_back(a, count + k);
                }
            }
        }
        std::sort(overlapping_.begin(), overlapping_.end());
    }

    /// The pairs that share a cell.
    void collectShown(const BodyView<Real>& bodies, const Partition<Real>& partition,
                      Real inflation) {
        // Sums of inflated extents are rounded in another order here; a pair that overlaps must not
        // be lost to that.
        const Real slack = inflation > 0 ? inflation + 8 * std::numeric_limits<Real>::epsilon() *
                                                           (inflation + largestHalfExtent(bodies))
                                         : Real(0);
        const auto count = static_cast<std::uint32_t>(bodies.moving.size());
        shown_.clear();
        withSizes(bodies, [&](const auto& sizes) {
            walk_.walk(
                bodies, partition, sizes, slack, 0, partition.cells.size(),
                [&](std::uint32_t a, const BodyRef* others, auto hits) {
                    forEachBit(hits,
                               [&](std::size_t l) { shown_.emplace_back(a, others[l].row()); });
                },
                [&](StaticPair p) { shown_.emplace_back(p.a, count + p.fixed); });
        });
        std::sort(shown_.begin(), shown_.end());
    }

    std::uint64_t every_;
    bool started_ = false;
    CellWalk<Real> walk_;
    std::vector<std::uint32_t> order_;
    std::vector<Pair> overlapping_, shown_;
};

}  // namespace quadrille
