#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "collision/narrow_phase.hpp"
#include "collision/quadtree.hpp"

namespace quadrille {

/// Counts the overlapping pairs that a partition does not show to the narrow phase, by comparison
/// with a tree that is built for the purpose.
template <class Real>
class MissedPairCounter {
  public:
    explicit MissedPairCounter(const Vec2& worldSize) : complete_(Quadtree{}, worldSize) {}

    std::uint64_t count(const BodyView<Real>& bodies, const Partition<Real>& partition) {
        complete_.update(bodies, Real(0), Real(0));
        // Pairs that a stale partition shows are tested like any other, so they are a subset.
        return pairs(bodies, complete_.partition()) - pairs(bodies, partition);
    }

  private:
    std::uint64_t pairs(const BodyView<Real>& bodies, const Partition<Real>& partition) {
        found_.clear();
        NarrowPhase<Real> narrowPhase;
        const auto movingCount = static_cast<std::uint32_t>(bodies.moving.size());
        narrowPhase.find(
            bodies, partition, [&](MovingPair p) { found_.emplace_back(p.a, p.b); },
            [&](StaticPair p) { found_.emplace_back(p.a, movingCount + p.fixed); });
        std::sort(found_.begin(), found_.end());
        return static_cast<std::uint64_t>(std::unique(found_.begin(), found_.end()) -
                                          found_.begin());
    }

    QuadtreePartitioner<Real> complete_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found_;
};

}  // namespace quadrille
