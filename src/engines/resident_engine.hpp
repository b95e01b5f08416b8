#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "collision/pairs/missed_pairs.hpp"
#include "core/engine.hpp"
#include "cuda/resident_pipeline.hpp"
#include "engines/host_engine.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// A step on a device that keeps the bodies. They come to the host when somebody reads them there,
/// and go to the device again only after an edit, or after a step that the host did: one that
/// somebody audits, the first of a law that keeps anchors, and what its pipeline does not do. A
/// device that fails loses nothing: the host has the bodies as they were read last, or edited, and
/// goes through the steps since then again.
template <class Real>
class ResidentEngine final : public Engine, public BodyMirror {
  public:
    using MakePipeline = std::unique_ptr<ResidentPipeline<Real>> (*)(const SimulationConfig&,
                                                                     const Vec2&,
                                                                     const ThreadTeam&);

    /// Throws what makeEngine does.
    ResidentEngine(const SimulationConfig& config, const Vec2& worldSize, unsigned threads,
                   MakePipeline make = nullptr);
    ~ResidentEngine() override;

    void step(BodyStore& store, StepWindow& window, StepReport& report) override;
    void fetch(BodyStore& store) override;

    const Cells& cells() const override;
    std::span<const ContactRecord> contacts() override;
    ResolverKind resolver() const override { return config_.resolver; }
    const std::string& failure() const override { return noFailure_; }
    unsigned threads() const override { return team_.threads(); }
    std::size_t bytes() const override;

  private:
    bool audited(const StepWindow& window) const;
    bool goesThere(const BodyStore& store, const StepWindow& window);
    bool send(BodyStore& store, const StepWindow& window, PhaseClock& clock);
    void stepThere(BodyStore& store, StepWindow& window, StepReport& report);
    void goOnHere(BodyStore& store, StepWindow& window, double done, ResolveCounts counts,
                  StepReport& report);
    void stepHere(BodyStore& store, StepWindow& window, StepReport& report);
    void repeatSteps(BodyStore& store);

    SimulationConfig config_;
    Vec2 worldSize_;
    ThreadTeam team_;  // used by what follows
    std::unique_ptr<ResidentPipeline<Real>> pipeline_;
    std::unique_ptr<HostEngine<Real>> host_;  // of steps that the device does not do
    std::unique_ptr<MissedPairCounter<Real>> audits_;
    bool lastWasHere_ = false;
    std::uint64_t pause_ = 0;            // steps for which the host goes on after what it was left
    std::uint64_t waiting_ = 0;          // those that are left of it
    std::vector<ContactRecord> joined_;  // of a step that both have done

    bool there_ = false;          // the device has the bodies
    std::uint64_t revision_ = 0;  // of the store, with which it has them
    std::uint64_t lastStep_ = 0;
    std::uint64_t ahead_ = 0;  // steps that the store has not seen
    std::string lost_;         // why the device failed outside a step
    Cells noCells_;
    std::string noFailure_;
};

}  // namespace quadrille
