#include "engines/resident_engine.hpp"

#include <utility>

#include <quadrille/error.hpp>
#include <quadrille/names.hpp>

#include "core/step_times.hpp"
#include "engines/registry.hpp"

namespace quadrille {

namespace {

/// The same law where there is no device.
SimulationConfig onHost(SimulationConfig config) {
    config.resolver = runsOn(config.law, ResolverKind::Threads) ? ResolverKind::Threads
                                                                : ResolverKind::Sequential;
    return config;
}

}  // namespace

template <class Real>
ResidentEngine<Real>::ResidentEngine(const SimulationConfig& config, const Vec2& worldSize,
                                     unsigned threads, MakePipeline make)
    : config_(config), worldSize_(worldSize), team_(threads, Thresholds{}) {
    if (!makePartitioner<Real>(config.partitioner, worldSize)->partition().complete) {
        throw NotAvailable("the resolver '" + std::string(name(config.resolver)) +
                           "' makes no partition that may miss pairs");
    }
    if (config.countMissedPairs) {
        audits_ = std::make_unique<MissedPairCounter<Real>>(config.missedPairsEvery);
    }
    pipeline_ = make != nullptr ? make(config, worldSize, team_)
                                : makeResident<Real>(config, worldSize, team_);
}

template <class Real>
ResidentEngine<Real>::~ResidentEngine() {
    try {
        bringHome();
    } catch (const Error&) {
        // Nobody is left to hear of a position that is not finite.
    }
}

template <class Real>
bool ResidentEngine<Real>::audited(const StepWindow& window) const {
    return audits_ && audits_->picks(window.number);
}

template <class Real>
void ResidentEngine<Real>::step(BodyStore& store, StepWindow& window, StepReport& report) {
    if (!lost_.empty()) throw DeviceError(lost_);
    lastWasHere_ = audited(window);
    if (lastWasHere_) {
        stepHere(store, window, report);
    } else {
        stepThere(store, window, report);
    }
}

template <class Real>
void ResidentEngine<Real>::stepThere(BodyStore& store, StepWindow& window, StepReport& report) {
    PhaseClock clock(report, config_.profile);
    Step<Real> step{.parameters = parametersOf<Real>(config_.step, window.from),
                    .from = window.from,
                    .to = window.to,
                    .keepContacts = window.keepContacts,
                    .clock = clock};
    try {
        const bool follows = ahead_ == 0 || window.number == lastStep_ + 1;
        if (!std::exchange(there_, false) || revision_ != store.revision() || !follows) {
            const BodyView<Real> bodies = store.read<Real>();
            ahead_ = 0;
            pipeline_->load(bodies, clock);
            revision_ = bodies.revision;
        }
        pipeline_->step(step);
    } catch (const DeviceError& failure) {
        lost_ = failure.what();
        store.newestIs(nullptr);
        repeatSteps(store);
        throw;
    } catch (const Error&) {
        // As on the host, where whoever looks sees where the bodies got to.
        ++ahead_;
        lastStep_ = window.number;
        store.newestIs(nullptr);
        fetch(store);
        throw;
    }
    there_ = true;
    ++ahead_;
    lastStep_ = window.number;
    store.advancedBy(*this, physicsOf(config_.law, config_.step));
    report.rebuilt = true;
    report.contacts = step.counts.contacts;
    report.collisions = step.counts.collisions;
    report.pairsTested = step.counts.pairsTested;
}

/// What counts missed pairs looks at a partition of the host.
template <class Real>
void ResidentEngine<Real>::stepHere(BodyStore& store, StepWindow& window, StepReport& report) {
    if (!host_) {
        host_ = std::make_unique<HostEngine<Real>>(onHost(config_), worldSize_, team_.threads(),
                                                   Thresholds{});
    }
    there_ = false;
    host_->step(store, window, report);
}

template <class Real>
void ResidentEngine<Real>::fetch(BodyStore& store) {
    try {
        pipeline_->fetch(store.advance<Real>({}, store.physics()));
        ahead_ = 0;
    } catch (const DeviceError& failure) {
        lost_ = failure.what();
        there_ = false;
        repeatSteps(store);
    }
}

/// Brings the store's bodies to where those of the device were: every resolver gives the same bits.
template <class Real>
void ResidentEngine<Real>::repeatSteps(BodyStore& store) {
    if (ahead_ == 0) return;
    SimulationConfig config = onHost(config_);
    config.countMissedPairs = false;
    config.profile = false;
    HostEngine<Real> host(config, worldSize_, team_.threads(), Thresholds{});
    const StepTimes times(config.step.dt);
    for (; ahead_ > 0; --ahead_) {
        const std::uint64_t number = lastStep_ - ahead_ + 1;
        StepWindow window{.number = number,
                          .from = times.at(number - 1),
                          .to = times.at(number),
                          .keepContacts = false};
        StepReport unread;
        host.step(store, window, unread);
    }
}

template <class Real>
const Cells& ResidentEngine<Real>::cells() const {
    if (lastWasHere_) return host_->cells();
    try {
        return pipeline_->cells();
    } catch (const DeviceError&) {
        return noCells_;  // the next step will say so
    }
}

template <class Real>
std::span<const ContactRecord> ResidentEngine<Real>::contacts() {
    return lastWasHere_ ? host_->contacts() : pipeline_->contacts();
}

template <class Real>
std::size_t ResidentEngine<Real>::bytes() const {
    return pipeline_->bytes() + (host_ ? host_->bytes() : 0);
}

template class ResidentEngine<double>;
template class ResidentEngine<float>;

}  // namespace quadrille
