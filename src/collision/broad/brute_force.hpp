#pragma once

#include "collision/broad/partitioner.hpp"

namespace quadrille {

/// One cell with every body in it: slow and obviously complete.
template <class Real>
class BruteForcePartitioner final : public Partitioner<Real> {
  public:
    explicit BruteForcePartitioner(const Vec2& worldSize) {
        Cells& cells = this->partition_.cells;
        cells.origin = -worldSize / 2;
        cells.fineCell = worldSize;
        cells.offsets = {0, 0};
        cells.coordinates = {CellCoordinates{}};
    }

    bool update(const BodyView<Real>& bodies, Real, Real reach) override {
        auto& partition = this->partition_;
        partition.margin = reach;
        const auto count = static_cast<std::uint32_t>(bodies.size());
        partition.ranges.assign(count, FineRange{0, 0, 0, 0});
        partition.cells.bodies.resize(count);
        for (std::uint32_t i = 0; i < count; ++i) partition.cells.bodies[i] = i;
        partition.cells.offsets[1] = count;
        ++partition.generation;
        return true;
    }
};

}  // namespace quadrille
