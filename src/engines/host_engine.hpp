#pragma once

#include <memory>

#include "collision/law.hpp"
#include "collision/pairs/missed_pairs.hpp"
#include "core/engine.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// Throws NotAvailable if the law needs a partition that misses no pair and there is none.
void requireWhole(const SimulationConfig& config, bool complete);

/// A step on the host: the partition is made here, and the law is one of the host's threads or one
/// that keeps a copy of the bodies on a device and resolves there.
template <class Real>
class HostEngine final : public Engine {
  public:
    /// On as many threads as the configuration asks for. Throws what makeEngine does.
    HostEngine(const SimulationConfig& config, const Vec2& worldSize,
               const Thresholds& thresholds = {});
    HostEngine(const SimulationConfig& config, const Vec2& worldSize, unsigned threads,
               const Thresholds& thresholds);

    void step(BodyStore& store, StepWindow& window, StepReport& report) override;

    /// For bodies that somebody else will advance: the law knows nothing of them afterwards.
    void forget();

    const Cells& cells() const override { return partitioner_->partition().cells; }
    std::span<const ContactRecord> contacts() override { return law_->contacts(); }
    ResolverKind resolver() const override { return config_.resolver; }
    const std::string& failure() const override { return noFailure_; }
    unsigned threads() const override { return team_.threads(); }
    std::size_t bytes() const override { return partitioner_->bytes() + law_->bytes(); }

  private:
    void partition(const LawBodies<Real>& bodies, const Reach<Real>& reach, StepReport& report);
    void audit(const LawBodies<Real>& bodies, const Reach<Real>& reach, StepReport& report,
               PhaseClock& clock);

    SimulationConfig config_;
    ThreadTeam team_;                                       // used by what follows
    std::unique_ptr<MissedPairCounter<Real>> missedPairs_;  // null unless asked for
    std::unique_ptr<Partitioner<Real>> partitioner_;
    std::unique_ptr<ContactLaw<Real>> law_;
    std::string noFailure_;
};

}  // namespace quadrille
