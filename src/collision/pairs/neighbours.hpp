#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <quadrille/body_ref.hpp>

#include "collision/pairs/cell_walk.hpp"
#include "collision/pairs/threads_candidate_pairs.hpp"

namespace quadrille {

/// For each moving body, the bodies that it may meet.
class Neighbours {
  public:
    template <class Real>
    void link(std::size_t rows, const ThreadsCandidatePairs<Real>& pairs) {
        starts_.assign(rows + 1, 0);
        const auto forAll = [&](auto&& onMoving, auto&& onFixed) {
            pairs.forShare(
                0, 1,
                [&](std::span<const MovingPair> p) { std::for_each(p.begin(), p.end(), onMoving); },
                [&](std::span<const StaticPair> p) { std::for_each(p.begin(), p.end(), onFixed); });
        };
        forAll(
            [&](MovingPair p) {
                ++starts_[p.a];
                ++starts_[p.b];
            },
            [&](StaticPair p) { ++starts_[p.a]; });
        std::uint32_t end = 0;
        for (std::size_t i = 0; i < rows; ++i) starts_[i] = end += starts_[i];
        starts_[rows] = end;
        others_.resize(end);
        forAll(
            [&](MovingPair p) {
                others_[--starts_[p.a]] = BodyRef::moving(p.b);
                others_[--starts_[p.b]] = BodyRef::moving(p.a);
            },
            [&](StaticPair p) { others_[--starts_[p.a]] = BodyRef::fixed(p.fixed); });
    }

    std::span<const BodyRef> operator[](std::uint32_t row) const {
        return {others_.data() + starts_[row], others_.data() + starts_[row + 1]};
    }

    /// Brings into the cache where the list of a body begins; then, the list.
    void prefetch(std::uint32_t row) const {
#if defined(__GNUC__)
        __builtin_prefetch(starts_.data() + row);
#endif
    }
    void prefetchList(std::uint32_t row) const {
#if defined(__GNUC__)
        __builtin_prefetch(others_.data() + starts_[row]);
#endif
    }

    std::size_t bytes() const {
        return starts_.capacity() * sizeof(std::uint32_t) + others_.capacity() * sizeof(BodyRef);
    }

  private:
    std::vector<std::uint32_t> starts_;
    std::vector<BodyRef> others_;
};

}  // namespace quadrille
