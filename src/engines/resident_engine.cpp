#include "engines/resident_engine.hpp"

#include <algorithm>
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
    const bool complete =
        makePartitioner<Real>(config.partitioner, worldSize)->partition().complete;
    requireWhole(config, complete);
    if (!complete) {
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

/// Whether the step may go to the device: a law that keeps anchors begins on the host, which also
/// takes over what was edited, and what the device left to the host goes there for a while.
template <class Real>
bool ResidentEngine<Real>::goesThere(const BodyStore& store, const StepWindow& window) {
    if (audited(window) || !pipeline_->runs()) return false;
    if (waiting_ > 0) {
        --waiting_;
        return false;
    }
    const bool known =
        store.edits() == Edits::None && store.physics() == physicsOf(config_.law, config_.step);
    return known || !pipeline_->kept().anchors;
}

template <class Real>
void ResidentEngine<Real>::step(BodyStore& store, StepWindow& window, StepReport& report) {
    if (!lost_.empty()) throw DeviceError(lost_);
    joined_.clear();
    if (goesThere(store, window)) {
        stepThere(store, window, report);
    } else {
        stepHere(store, window, report);
    }
}

/// Has the device take over the store's bodies, if it has not got them. Returns whether it has.
template <class Real>
bool ResidentEngine<Real>::send(BodyStore& store, const StepWindow& window, PhaseClock& clock) {
    // A pipeline of a law that keeps anchors knows what time it is.
    const bool follows =
        (ahead_ == 0 && !pipeline_->kept().anchors) || window.number == lastStep_ + 1;
    if (std::exchange(there_, false) && revision_ == store.revision() && follows) return true;
    store.read<Real>();  // also has bodies placed that are to be placed later
    ahead_ = 0;
    const LawBodies<Real> bodies =
        store.advance<Real>(pipeline_->kept(), physicsOf(config_.law, config_.step));
    revision_ = bodies.revision;
    return pipeline_->load(bodies, window.from, clock);
}

template <class Real>
void ResidentEngine<Real>::stepThere(BodyStore& store, StepWindow& window, StepReport& report) {
    PhaseClock clock(report, config_.profile);
    Step<Real> step{.parameters = parametersOf<Real>(config_.step, window.from),
                    .from = window.from,
                    .to = window.to,
                    .keepContacts = window.keepContacts,
                    .clock = clock};
    double done = window.from;
    try {
        if (!send(store, window, clock)) return stepHere(store, window, report);
        if (std::exchange(lastWasHere_, false) && host_ && pipeline_->kept().anchors) {
            host_->forget();
        }
        done = pipeline_->step(step);
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
    if (done < window.to) {
        goOnHere(store, window, done, step.counts, report);
        return;
    }
    there_ = true;
    if (pause_ > 0) --pause_;
    ++ahead_;
    lastStep_ = window.number;
    store.advancedBy(*this, pipeline_->kept(), physicsOf(config_.law, config_.step));
    report.rebuilt = step.rebuilt;
    report.contacts = step.counts.contacts;
    report.collisions = step.counts.collisions;
    report.pairsTested = step.counts.pairsTested;
}

/// The host does what is left of a step that the device has done up to a time, s.
template <class Real>
void ResidentEngine<Real>::goOnHere(BodyStore& store, StepWindow& window, double done,
                                    ResolveCounts counts, StepReport& report) {
    constexpr std::uint64_t longestPause = 256;
    pause_ = std::min(2 * pause_ + 1, longestPause);
    waiting_ = pause_;
    const auto records = pipeline_->contacts();
    joined_.assign(records.begin(), records.end());
    store.newestIs(nullptr);
    fetch(store);
    if (!lost_.empty()) {
        // The store has the bodies as the step began.
        done = window.from;
        counts = {};
        joined_.clear();
    }
    there_ = false;
    StepWindow rest = window;
    rest.from = done;
    stepHere(store, rest, report);
    window.begun = rest.begun;
    report.leftToHost = true;
    report.contacts += counts.contacts;
    report.collisions += counts.collisions;
    report.pairsTested += counts.pairsTested;
    const auto others = host_->contacts();
    joined_.insert(joined_.end(), others.begin(), others.end());
}

template <class Real>
void ResidentEngine<Real>::stepHere(BodyStore& store, StepWindow& window, StepReport& report) {
    lastWasHere_ = true;
    if (!host_) {
        host_ = std::make_unique<HostEngine<Real>>(onHost(config_), worldSize_, team_.threads(),
                                                   Thresholds{});
    }
    there_ = false;
    host_->step(store, window, report);
    report.leftToHost = true;
}

template <class Real>
void ResidentEngine<Real>::fetch(BodyStore& store) {
    try {
        pipeline_->fetch(store.advance<Real>(pipeline_->kept(), store.physics()));
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
    if (!joined_.empty()) return joined_;
    return lastWasHere_ ? host_->contacts() : pipeline_->contacts();
}

template <class Real>
std::size_t ResidentEngine<Real>::bytes() const {
    return pipeline_->bytes() + (host_ ? host_->bytes() : 0) +
           joined_.capacity() * sizeof(ContactRecord);
}

template class ResidentEngine<double>;
template class ResidentEngine<float>;

}  // namespace quadrille
