#include "engines/host_engine.hpp"

#include <chrono>
#include <system_error>

#include <quadrille/error.hpp>
#include <quadrille/names.hpp>

#include "collision/integrate.hpp"
#include "engines/registry.hpp"

namespace quadrille {

namespace {

ThreadTeam startTeam(unsigned threads, const Thresholds& thresholds) {
    try {
        return ThreadTeam(threads, thresholds);
    } catch (const std::system_error& error) {
        throw Error(error.what());
    }
}

}  // namespace

template <class Real>
HostEngine<Real>::HostEngine(const SimulationConfig& config, const Vec2& worldSize,
                             const Thresholds& thresholds)
    : HostEngine(config, worldSize, threadsOf(config), thresholds) {}

void requireWhole(const SimulationConfig& config, bool complete) {
    if (config.law == Law::Continuous && !complete) {
        throw NotAvailable("the law '" + std::string(name(config.law)) +
                           "' needs a partition that misses no pair; '" +
                           std::string(name(Law::Impulse)) + "' does not");
    }
}

template <class Real>
HostEngine<Real>::HostEngine(const SimulationConfig& config, const Vec2& worldSize,
                             unsigned threads, const Thresholds& thresholds)
    : config_(config),
      team_(startTeam(threads, thresholds)),
      partitioner_(makePartitioner<Real>(config.partitioner, worldSize, team_)),
      law_(makeLaw<Real>(config, team_)) {
    if (config.countMissedPairs) {
        missedPairs_ = std::make_unique<MissedPairCounter<Real>>(config.missedPairsEvery);
    }
    requireWhole(config, partitioner_->partition().complete);
}

template <class Real>
void HostEngine<Real>::forget() {
    law_ = makeLaw<Real>(config_, team_);
}

template <class Real>
void HostEngine<Real>::step(BodyStore& store, StepWindow& window, StepReport& report) {
    const LawBodies<Real> bodies =
        store.advance<Real>(law_->kept(), physicsOf(config_.law, config_.step));
    PhaseClock clock(report, config_.profile);
    const bool audited = missedPairs_ && missedPairs_->picks(window.number);
    Step<Real> step{.parameters = parametersOf<Real>(config_.step, window.from),
                    .from = window.from,
                    .to = window.to,
                    .keepContacts = window.keepContacts,
                    .audited = audited,
                    .clock = clock};
    double now = window.from;
    // Whether it gets through or not: a step may end in an error.
    struct Placing {
        BodyStore& store;
        const ContactLaw<Real>& law;
        const double& now;
        ~Placing() {
            if (!law.placed()) store.placeLater(now);
        }
    } const placing{store, *law_, now};
    if (!window.begun) law_->begin(bodies, step);
    window.begun = true;
    clock.finish(Phase::Integrate);
    while (now < window.to) {
        const auto reach = law_->reach(bodies, now, window.to);
        if (reach) {
            partition(bodies, *reach, report);
            clock.finish(Phase::Partition);
        }
        if (audited && (reach || now == window.from)) {
            audit(bodies, reach.value_or(Reach<Real>{}), report, clock);
        }
        now = law_->advance(bodies, partitioner_->partition(), now, step);
        clock.finish(Phase::Resolve);
    }
    report.contacts = step.counts.contacts;
    report.collisions = step.counts.collisions;
    report.pairsTested = step.counts.pairsTested;
}

template <class Real>
void HostEngine<Real>::partition(const LawBodies<Real>& bodies, const Reach<Real>& reach,
                                 StepReport& report) {
    const auto dt = static_cast<Real>(config_.step.dt);
    const bool rebuilt = partitioner_->update(bodies.read(), dt, reach);
    report.rebuilt = report.rebuilt || rebuilt;
    // A skin notices a NaN as a body that left its box, so checking at builds sees every one; a
    // tree that is kept for so many steps, whatever happens, notices nothing.
    if (rebuilt || !partitioner_->partition().complete) requireFinite(bodies.read(), team_);
}

/// Adds to the report what the partition does not show of the pairs that overlap, or would after
/// moving up to `reach`.
template <class Real>
void HostEngine<Real>::audit(const LawBodies<Real>& bodies, const Reach<Real>& reach,
                             StepReport& report, PhaseClock& clock) {
    const auto start = std::chrono::steady_clock::now();
    const PairAudit audit =
        missedPairs_->count(bodies.read(), partitioner_->partition(), reach.common);
    report.audited = true;
    report.overlappingPairs += audit.overlapping;
    report.missedPairs += audit.missed;
    report.auditSeconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    clock.restart();
}

template class HostEngine<double>;
template class HostEngine<float>;

}  // namespace quadrille
