#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/simulation.hpp>

#include "collision/broad/partitioner.hpp"
#include "collision/resolver.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// The law `continuous`: all events of a step in the order of time, found again for the bodies that
/// an event changed (event-driven simulation of hard bodies; Alder & Wainwright 1959).
template <class Real>
class ContinuousLaw {
  public:
    virtual ~ContinuousLaw() = default;

    /// Anchors the bodies that have no anchor yet: all of them at first, later those that were
    /// created or edited from outside. Must be called at the start of each step.
    virtual void anchor(const BodyView<Real>& bodies, double now) = 0;

    /// How far a body may move between two times, along either axis, unless an event makes it
    /// faster than every body is now.
    virtual Real reach(const BodyView<Real>& bodies, double from, double to) = 0;

    /// Runs the events from `from` to `to`, the positions being those at `from`, and the partition
    /// one that covers `reach`. Returns `to`, or the time of an event that made a body too fast for
    /// the partition; then positions are to be placed there, and the call repeated with a new one.
    virtual double advance(const BodyView<Real>& bodies, const Partition<Real>& partition,
                           Real reach, double from, double to, std::vector<ContactRecord>* records,
                           ResolveCounts& counts) = 0;

    /// Writes the positions, and under gravity the velocities, of all bodies at time t. Returns
    /// whether they are finite.
    virtual bool place(const BodyView<Real>& bodies, double t) const = 0;

    /// Bytes of work space.
    virtual std::size_t bytes() const = 0;
};

/// `team` shares out the loops of a step and must outlive the law. Throws NotAvailable if this
/// version does not run the law as the configuration asks.
template <class Real>
std::unique_ptr<ContinuousLaw<Real>> makeContinuousLaw(const SimulationConfig& config,
                                                       const ThreadTeam& team);

}  // namespace quadrille
