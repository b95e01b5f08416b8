#pragma once

#include <memory>
#include <string>
#include <vector>

#include <quadrille/error.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/world.hpp>

#include "collision/broad/partitioner.hpp"
#include "collision/continuous/continuous_law.hpp"
#include "collision/pairs/missed_pairs.hpp"
#include "collision/phase_clock.hpp"
#include "collision/resolver.hpp"
#include "core/step_times.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// The frame in one precision: integrate, partition, resolve.
template <class Real>
class Stepper {
  public:
    /// `eager` shares out even the shortest loops, for tests of that.
    Stepper(const SimulationConfig& config, const Vec2& worldSize, bool eager = false);

    /// One step, the `number`-th of the run, from 1. Contacts go to `records` unless it is null.
    /// Fills the report's counts and, with `profile`, its times.
    void step(World& world, std::uint64_t number, std::vector<ContactRecord>* records,
              StepReport& report, bool profile);

    /// Why the resolver that was asked for was replaced by the sequential one; empty if it was not.
    const std::string& resolverFailure() const { return resolverFailure_; }
    /// That share out the loops of a step.
    unsigned threads() const { return team_->threads(); }

    const Cells& cells() const { return partitioner_->partition().cells; }
    std::size_t bytes() const {
        return partitioner_->bytes() + (resolver_ ? resolver_->bytes() : continuous_->bytes());
    }

  private:
    ResolveCounts stepDiscrete(const BodyView<Real>& bodies, std::uint64_t number,
                               std::vector<ContactRecord>* records, StepReport& report,
                               PhaseClock& clock);
    ResolveCounts stepContinuous(const BodyView<Real>& bodies, std::uint64_t number,
                                 std::vector<ContactRecord>* records, StepReport& report,
                                 PhaseClock& clock);
    void updatePartition(const BodyView<Real>& bodies, Real reach, StepReport& report);
    void integrate(const BodyView<Real>& bodies) const;

    /// Calls `function(Resolver<Real>&)`. If a device fails in it, goes on with the sequential
    /// resolver where the configuration allows that.
    template <class Function>
    decltype(auto) onResolver(const BodyView<Real>& bodies, StepReport& report,
                              Function&& function);
    void useSequential(SimulationConfig config, const DeviceError& failure);

    /// Adds to the report what the partition does not show of the pairs that overlap, or would
    /// after moving up to `reach`.
    void countMissedPairs(const BodyView<Real>& bodies, Real reach, StepReport& report);

    StepParameters<Real> parameters_;
    std::unique_ptr<ThreadTeam> team_;  // used by what follows, at an address that stays
    std::unique_ptr<MissedPairCounter<Real>> missedPairs_;  // null unless asked for
    std::unique_ptr<Partitioner<Real>> partitioner_;
    std::unique_ptr<Resolver<Real>> resolver_;         // of a discrete law, or
    std::unique_ptr<ContinuousLaw<Real>> continuous_;  // the continuous one
    StepTimes times_;
    SimulationConfig config_;
    Vec2 worldSize_{0, 0};
    std::string resolverFailure_;
};

}  // namespace quadrille
