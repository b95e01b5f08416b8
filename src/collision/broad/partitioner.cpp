#include "collision/broad/partitioner.hpp"

#include <algorithm>
#include <type_traits>

#include "collision/broad/brute_force.hpp"
#include "collision/broad/quadtree.hpp"
#include "collision/broad/semi_static_quadtree.hpp"
#include "collision/broad/static_grid.hpp"

namespace quadrille {

Bounds Cells::bounds(std::size_t cell) const {
    const CellCoordinates& c = coordinates[cell];
    const double side = double(1u << c.shift);
    const Vec2 low = origin + Vec2(c.x * fineCell.x(), c.y * fineCell.y());
    return {low, low + side * fineCell};
}

CellLoad loadOf(const Cells& cells) {
    CellLoad result{.cells = cells.size()};
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const std::size_t count = cells[c].size();
        result.activeCells += count > 0;
        result.maxBodies = std::max(result.maxBodies, count);
    }
    if (result.activeCells > 0) {
        result.meanBodies = double(cells.bodies.size()) / double(result.activeCells);
    }
    return result;
}

template <class Real>
std::unique_ptr<Partitioner<Real>> makePartitioner(const PartitionerConfig& config,
                                                   const Vec2& worldSize, const ThreadTeam& team) {
    return std::visit(
        [&]<class C>(const C& c) -> std::unique_ptr<Partitioner<Real>> {
            if constexpr (std::is_same_v<C, BruteForce>) {
                return std::make_unique<BruteForcePartitioner<Real>>(worldSize);
            } else if constexpr (std::is_same_v<C, StaticGrid>) {
                return std::make_unique<StaticGridPartitioner<Real>>(c, worldSize, team);
            } else if constexpr (std::is_same_v<C, Quadtree>) {
                return std::make_unique<QuadtreePartitioner<Real>>(c, worldSize, team);
            } else {
                return std::make_unique<SemiStaticQuadtreePartitioner<Real>>(c, worldSize, team);
            }
        },
        config);
}

template std::unique_ptr<Partitioner<double>> makePartitioner(const PartitionerConfig&, const Vec2&,
                                                              const ThreadTeam&);
template std::unique_ptr<Partitioner<float>> makePartitioner(const PartitionerConfig&, const Vec2&,
                                                             const ThreadTeam&);

}  // namespace quadrille
