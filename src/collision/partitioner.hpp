#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/partitioner.hpp>
#include <quadrille/vec2.hpp>

#include "collision/fine_grid.hpp"

namespace quadrille {

/// Cells, and what the narrow phase needs to know about how they were made.
template <class Real>
struct Partition {
    Cells cells;
    std::vector<FineRange> ranges;  ///< of every body when the cells were made
    Real margin = 0;                ///< by how much boxes were inflated on each side, px
    bool complete = true;           ///< every overlapping pair shares a cell
    std::uint64_t generation = 0;   ///< counts the builds

    /// The one cell, among those that two bodies share, in which their pair is looked at: the one
    /// that holds the low corner of the intersection of their ranges.
    bool owns(std::size_t cell, std::uint32_t a, std::uint32_t b) const {
        const FineRange& p = ranges[a];
        const FineRange& q = ranges[b];
        return cells.coordinates[cell].contains(p.x0 > q.x0 ? p.x0 : q.x0,
                                                p.y0 > q.y0 ? p.y0 : q.y0);
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

    /// Makes the partition fit the bodies, which move for `dt` a step. Returns whether it was built
    /// anew. Throws Error if there are more cells or entries than 32 bits can count.
    virtual bool update(const BodyView<Real>& bodies, Real dt) = 0;

    virtual std::size_t bytes() const { return partition_.bytes(); }

    const Partition<Real>& partition() const { return partition_; }

  protected:
    Partition<Real> partition_;
};

/// Throws Error for impossible parameters.
template <class Real>
std::unique_ptr<Partitioner<Real>> makePartitioner(const PartitionerConfig& config,
                                                   const Vec2& worldSize);

}  // namespace quadrille
