#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/cells.hpp>
#include <quadrille/partitioner_config.hpp>
#include <quadrille/vec2.hpp>

#include "collision/rules/cell_ownership.hpp"
#include "collision/rules/fine_grid.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// How far bodies may get along either axis from where they are, before a partitioner is asked
/// again, px. Static ones get nowhere, but have the common reach all the same.
template <class Real>
struct Reach {
    Real common = 0;
    std::span<const Real>
        own{};  ///< of each moving row, at least the common one; empty if all have it

    Reach() = default;
    Reach(Real ofAll) : common(ofAll) {}
    Reach(Real ofMost, std::span<const Real> ofEach) : common(ofMost), own(ofEach) {}
};

/// How many of the members of a cell move; the static ones stand last.
inline std::size_t movingAmong(std::span<const BodyRef> members) {
    std::size_t moving = members.size();
    while (moving > 0 && members[moving - 1].isStatic()) --moving;
    return moving;
}

/// Cells, and what the narrow phase needs to know about how they were made.
template <class Real>
struct Partition {
    Cells cells;
    FineGrid<Real> grid;            ///< what the cells are made of
    std::vector<FineRange> ranges;  ///< of every body when the cells were made, moving ones first
    std::uint32_t movingCount = 0;  ///< bodies then
    Real margin = 0;                ///< by how much boxes were inflated on each side, px
    std::vector<Real> extra;        ///< by how much more those of moving rows; empty if none was
    bool complete = true;           ///< every overlapping pair shares a cell
    std::uint64_t generation = 0;   ///< counts the builds

    const FineRange& rangeOf(BodyRef body) const {
        return ranges[body.isStatic() ? movingCount + body.row() : body.row()];
    }
    CrossedEdges crossedEdges(std::size_t cell, BodyRef body) const {
        if (!complete) return {false, false};
        return crossedEdgesOf(cells.coordinates[cell], rangeOf(body));
    }
    CrossedEdges crossedEdgesOfMoving(std::size_t cell, std::uint32_t row) const {
        if (!complete) return {false, false};
        return crossedEdgesOf(cells.coordinates[cell], ranges[row]);
    }
    /// The body of a place in `ranges`.
    BodyRef bodyAt(std::size_t i) const {
        const auto k = static_cast<std::uint32_t>(i);
        return k < movingCount ? BodyRef::moving(k) : BodyRef::fixed(k - movingCount);
    }
    /// Makes room for the ranges of these bodies, whose boxes are inflated by their reach and what
    /// is to be added to it.
    void beginBuild(const BodyView<Real>& all, const Reach<Real>& reach, Real added) {
        movingCount = static_cast<std::uint32_t>(all.moving.size());
        ranges.resize(all.size());
        margin = reach.common + added;
        extra.resize(reach.own.size());
        for (std::size_t i = 0; i < extra.size(); ++i) extra[i] = reach.own[i] - reach.common;
    }
    Real largestExtra() const {
        return extra.empty() ? Real(0) : *std::max_element(extra.begin(), extra.end());
    }

    std::size_t bytes() const {
        return cells.offsets.capacity() * sizeof(std::uint32_t) +
               cells.bodies.capacity() * sizeof(BodyRef) +
               cells.coordinates.capacity() * sizeof(CellCoordinates) +
               ranges.capacity() * sizeof(FineRange) + extra.capacity() * sizeof(Real);
    }
};

/// The broad phase: bodies in, cells out. Implementations keep their buffers, so that a step
/// allocates nothing once the numbers of bodies and cells have settled.
template <class Real>
class Partitioner {
  public:
    virtual ~Partitioner() = default;

    /// Makes the partition fit the bodies, and every place that they can get to within their reach.
    /// `dt` is the length of a step, for those that plan ahead. Returns whether the partition was
    /// built anew. Throws Error if there are more cells or entries than
    /// 32 bits can count.
    virtual bool update(const BodyView<Real>& bodies, Real dt, const Reach<Real>& reach) = 0;

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
