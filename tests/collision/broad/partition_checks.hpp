#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/partitioner_config.hpp>

#include "collision/broad/partitioner.hpp"
#include "collision/pairs/narrow_phase.hpp"

namespace quadrille {

/// One step's update, for bodies that move no further in the step.
template <class Real>
bool update(Partitioner<Real>& partitioner, const BodyView<Real>& bodies, double dt = 1.0 / 60) {
    return partitioner.update(bodies, Real(dt), Real(0));
}

/// Pairs of bodies, sorted; static bodies count on after the moving ones, as in Boxes.
using PairList = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// The boxes of all bodies, moving ones first.
template <class Real>
struct Boxes {
    std::vector<Real> x, y, halfWidth, halfHeight;
    std::uint32_t moving = 0;

    explicit Boxes(const BodyView<Real>& bodies);
    std::uint32_t size() const { return static_cast<std::uint32_t>(x.size()); }
    std::uint32_t numberOf(BodyRef body) const {
        return body.isStatic() ? moving + body.row() : body.row();
    }

    /// Open boxes intersect; the definition, independent of the engine's code.
    bool overlap(std::uint32_t a, std::uint32_t b) const;
};

/// Every overlapping pair of which at least one body moves, by comparison of all with all.
template <class Real>
PairList overlappingPairs(const Boxes<Real>& boxes);

/// What the narrow phase finds in a partition, with its repetitions.
template <class Real>
PairList foundPairs(NarrowPhase<Real>& narrowPhase, const BodyView<Real>& bodies,
                    const Partition<Real>& partition);

/// Says how two lists of pairs differ, or nothing.
std::string difference(const PairList& found, const PairList& expected);

/// The first thing that is wrong with the cells, or nothing: rows, ascent, and that bodies stand in
/// the cells that they touch, and in no other.
template <class Real>
std::string faultOfCells(const BodyView<Real>& bodies, const Partition<Real>& partition);

/// The same for what only quadtrees promise: leaves in Z order that tile the world, and no more
/// bodies in one than it may hold.
template <class Real>
std::string faultOfTree(const BodyView<Real>& bodies, const Partition<Real>& partition,
                        int maxDepth, int maxPerCell);

}  // namespace quadrille
