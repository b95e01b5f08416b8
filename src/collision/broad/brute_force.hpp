#pragma once

#include <algorithm>

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

    bool update(const BodyView<Real>& bodies, Real, const Reach<Real>& reach) override {
        auto& partition = this->partition_;
        const std::size_t count = bodies.size();
        partition.beginBuild(bodies, reach, 0);
        std::fill(partition.ranges.begin(), partition.ranges.end(), FineRange{0, 0, 0, 0});
        partition.cells.bodies.resize(count);
        for (std::size_t i = 0; i < count; ++i) partition.cells.bodies[i] = partition.bodyAt(i);
        partition.cells.offsets[1] = static_cast<std::uint32_t>(count);
        ++partition.generation;
        return true;
    }
};

}  // namespace quadrille
