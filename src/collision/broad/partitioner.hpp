#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/cells.hpp>
#include <quadrille/partitioner_config.hpp>
#include <quadrille/vec2.hpp>

#include "collision/rules/cell_ownership.hpp"
#include "collision/rules/fine_grid.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// Cells, and what the narrow phase needs to know about how they were made.
template <class Real>
struct Partition {
    Cells cells;
    FineGrid<Real> grid;            ///< what the cells are made of
    std::vector<FineRange> ranges;  ///< of every body when the cells were made
    Real margin = 0;                ///< by how much boxes were inflated on each side, px
    bool complete = true;           ///< every overlapping pair shares a cell
    std::uint64_t generation = 0;   ///< counts the builds

    CrossedEdges crossedEdges(std::size_t cell, std::uint32_t body) const {
        if (!complete) return {false, false};
        return crossedEdgesOf(cells.coordinates[cell], ranges[body]);
    }

    std::size_t bytes() const {
        return cells.offsets.capacity() * sizeof(std::uint32_t) +
               cells.bodies.capacity() * sizeof(std::uint32_t) +
               cells.coordinates.capacity() * sizeof(CellCoordinates) +
               ranges.capacity() * sizeof(FineRange);
    }
};

/// The broad phase: bodies in, cells out. Implementations keep their buffers, so that a step
/// allocates nothing once the numbers of bodies and cells have settled.
template <class Real>
class Partitioner {
  public:
    virtual ~Partitioner() = default;

    /// Makes the partition fit the bodies, and every place that they can get to by moving up to
    /// `reach` along each axis. `dt` is the length of a step, for those that plan ahead. Returns
    /// whether the partition was built anew. Throws Error if there are more cells or entries than
    /// 32 bits can count.
    virtual bool update(const BodyView<Real>& bodies, Real dt, Real reach) = 0;

    virtual std::size_t bytes() const { return partition_.bytes(); }

    const Partition<Real>& partition() const { return partition_; }

  protected:
    Partition<Real> partition_;
};

/// `team` builds the cells and must outlive the partitioner; they are the same whatever its size.
/// Throws Error for impossible parameters.
template <class Real>
std::unique_ptr<Partitioner<Real>> makePartitioner(const PartitionerConfig& config,
                                                   const Vec2& worldSize,
                                                   const ThreadTeam& team = ThreadTeam::serial());

}  // namespace quadrille
