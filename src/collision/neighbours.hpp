#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/cell_walk.hpp"
#include "collision/event_queue.hpp"

namespace quadrille {

/// For each moving body, the bodies that it may meet: rows, static ones with PairEvent::staticBit.
class Neighbours {
  public:
    void link(std::size_t rows, std::span<const MovingPair> moving,
              std::span<const StaticPair> fixed) {
        starts_.assign(rows + 1, 0);
        for (const MovingPair p : moving) {
            ++starts_[p.a];
            ++starts_[p.b];
        }
        for (const StaticPair p : fixed) ++starts_[p.a];
        std::uint32_t end = 0;
        for (std::size_t i = 0; i < rows; ++i) starts_[i] = end += starts_[i];
        starts_[rows] = end;
        others_.resize(end);
        for (const MovingPair p : moving) {
            others_[--starts_[p.a]] = p.b;
            others_[--starts_[p.b]] = p.a;
        }
        for (const StaticPair p : fixed) others_[--starts_[p.a]] = p.fixed | PairEvent::staticBit;
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
