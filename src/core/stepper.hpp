#pragma once

#include <memory>
#include <vector>

#include <quadrille/simulation.hpp>
#include <quadrille/world.hpp>

#include "collision/missed_pairs.hpp"
#include "collision/partitioner.hpp"
#include "collision/resolver.hpp"

namespace quadrille {

/// The frame in one precision: integrate, partition, resolve.
template <class Real>
class Stepper {
  public:
    Stepper(const SimulationConfig& config, const Vec2& worldSize);

    void setPartitioner(const SimulationConfig& config, const Vec2& worldSize);

    /// One step. Contacts go to `records` unless it is null. Fills the report's counts and, with
    /// `profile`, its times.
    void step(World& world, std::vector<ContactRecord>* records, StepReport& report, bool profile);

    const Cells& cells() const { return partitioner_->partition().cells; }
    std::size_t bytes() const { return partitioner_->bytes() + resolver_->bytes(); }

  private:
    void integrate(const BodyView<Real>& bodies) const;

    void countMissedPairs(const BodyView<Real>& bodies, StepReport& report);

    StepParameters<Real> parameters_;
    std::unique_ptr<MissedPairCounter<Real>> missedPairs_;  // null unless asked for
    std::unique_ptr<Partitioner<Real>> partitioner_;
    std::unique_ptr<Resolver<Real>> resolver_;
};

}  // namespace quadrille
