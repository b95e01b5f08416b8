#pragma once

#include "collision/partitioner.hpp"

namespace quadrille {

/// Equal cells over the world, filled anew each step by a counting sort.
template <class Real>
class StaticGridPartitioner final : public Partitioner<Real> {
  public:
    StaticGridPartitioner(const StaticGrid& config, const Vec2& worldSize);

    bool update(const BodyView<Real>& bodies, Real dt, Real reach) override;

  private:
    std::uint32_t columns_, rows_;
    FineGrid<Real> grid_;
};

}  // namespace quadrille
