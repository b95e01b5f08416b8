#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/continuous/event_queue.hpp"
#include "collision/pairs/candidate_lists.hpp"
#include "collision/pairs/cell_walk.hpp"

namespace quadrille {

/// For each moving body, the bodies that it may meet: rows, static ones with PairEvent::staticBit.
class Neighbours {
  public:
    template <class Real>
    void link(std::size_t rows, const CandidateLists<Real>& pairs) {
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
                others_[--starts_[p.a]] = p.b;
                others_[--starts_[p.b]] = p.a;
            },
            [&](StaticPair p) { others_[--starts_[p.a]] = p.fixed | PairEvent::staticBit; });
    }

    std::span<const std::uint32_t> operator[](std::uint32_t row) const {
        return {others_.data() + starts_[row], others_.data() + starts_[row + 1]};
    }

    std::size_t bytes() const {
        return (starts_.capacity() + others_.capacity()) * sizeof(std::uint32_t);
    }

  private:
    std::vector<std::uint32_t> starts_, others_;
};

}  // namespace quadrille
