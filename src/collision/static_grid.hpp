#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "collision/partitioner.hpp"

namespace quadrille {

/// Equal cells over the world, filled anew each step by a counting sort.
template <class Real>
class StaticGridPartitioner final : public Partitioner<Real> {
  public:
    StaticGridPartitioner(const StaticGrid& config, const Vec2& worldSize,
                          const ThreadTeam& team = ThreadTeam::serial());

    bool update(const BodyView<Real>& bodies, Real dt, Real reach) override;

    std::size_t bytes() const override;

  private:
    void fill();
    void fillInParallel();
    void requireCountable(std::uint64_t entries) const;

    template <class Function>
    void forEachCell(const FineRange& range, Function&& function) const {
        for (std::uint32_t y = range.y0; y <= range.y1; ++y) {
            const std::size_t row = std::size_t(y) * columns_;
            for (std::uint32_t x = range.x0; x <= range.x1; ++x) function(row + x);
        }
    }

    std::uint32_t columns_, rows_;
    FineGrid<Real> grid_;
    const ThreadTeam& team_;
    /// Bodies in each cell, and then where the next one goes; null while one thread suffices.
    std::unique_ptr<std::atomic<std::uint32_t>[]> cursors_;
};

}  // namespace quadrille
