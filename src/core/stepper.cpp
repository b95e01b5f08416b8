#include "core/stepper.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include <quadrille/error.hpp>

#include "collision/rules/motion.hpp"

namespace quadrille {

namespace {

/// `cuda` leaves the partition to the host, which is most of its step.
unsigned threadsOf(const SimulationConfig& config) {
    const bool shared =
        config.resolver == ResolverKind::Threads || config.resolver == ResolverKind::Cuda;
    if (!shared) return 1;
    return static_cast<unsigned>(config.threads > 0 ? config.threads : Simulation::cores());
}

template <class Real>
void advance(std::span<Real> position, std::span<Real> velocity, Real gravity, Real dt) {
    Real* const p = position.data();
    Real* const v = velocity.data();
    const std::size_t count = position.size();
    if (gravity != 0) {
        for (std::size_t i = 0; i < count; ++i) v[i] = accelerated(v[i], gravity, dt);
    }
    for (std::size_t i = 0; i < count; ++i) p[i] = moved(p[i], v[i], dt);
}

/// Stops a run before a NaN spreads.
template <class Real>
void requireFinite(const BodyView<Real>& bodies, const ThreadTeam& team) {
    const auto& m = bodies.moving;
    const Real* const x = m.x.data();
    const Real* const y = m.y.data();
    constexpr Real largest = std::numeric_limits<Real>::max();
    const bool anyBad =
        team.any(m.size(), worthwhile::streamed, [&](std::size_t begin, std::size_t end) {
            int bad = 0;
            for (std::size_t i = begin; i < end; ++i) {
                bad |= !(std::abs(x[i]) <= largest) | !(std::abs(y[i]) <= largest);
            }
            return bad != 0;
        });
    if (!anyBad) return;
    for (std::size_t i = 0; i < m.size(); ++i) {
        if (!std::isfinite(x[i]) || !std::isfinite(y[i])) {
            throw Error("entity " + std::to_string(m.entity[i]) +
                        ": its position is no longer finite");
        }
    }
}

}  // namespace

template <class Real>
Stepper<Real>::Stepper(const SimulationConfig& config, const Vec2& worldSize, bool eager)
    : parameters_{0, static_cast<Real>(config.dt), static_cast<Real>(config.gravity.x()),
                  static_cast<Real>(config.gravity.y()), static_cast<Real>(config.restitution)},
      team_(std::make_unique<ThreadTeam>(threadsOf(config), eager)),
      times_(config.dt) {
    if (config.countMissedPairs) {
        missedPairs_ = std::make_unique<MissedPairCounter<Real>>(config.missedPairsEvery);
    }
    // The resolver remembers pairs of the partition that it saw last, so both are made at once.
    partitioner_ = makePartitioner<Real>(config.partitioner, worldSize, *team_);
    if (config.law == Law::Continuous) {
        if (!partitioner_->partition().complete) {
            throw NotAvailable("the law 'continuous' needs a partition that misses no pair");
        }
        continuous_ = makeContinuousLaw<Real>(config, *team_);
    } else {
        try {
            resolver_ = makeResolver<Real>(config, *team_);
        } catch (const DeviceError& failure) {
            if (!config.fallback) throw;
            useSequential(config, failure);
        }
    }
    config_ = config;
    worldSize_ = worldSize;
}

template <class Real>
void Stepper<Real>::useSequential(SimulationConfig config, const DeviceError& failure) {
    config.resolver = ResolverKind::Sequential;
    resolver_ = makeResolver<Real>(config, *team_);
    resolverFailure_ = failure.what();
}

template <class Real>
template <class Function>
decltype(auto) Stepper<Real>::onResolver(const BodyView<Real>& bodies, StepReport& report,
                                         Function&& function) {
    try {
        return function(*resolver_);
    } catch (const DeviceError& failure) {
        if (!config_.fallback) throw;
        useSequential(config_, failure);
    }
    if (partitioner_->partition().complete) {
        // Candidate pairs can be collected only when the cells are made, so they are made anew.
        partitioner_ = makePartitioner<Real>(config_.partitioner, worldSize_, *team_);
        updatePartition(bodies, Real(0), report);
    }
    return function(*resolver_);
}

template <class Real>
void Stepper<Real>::integrate(const BodyView<Real>& bodies) const {
    const auto& m = bodies.moving;
    team_->shares(m.size(), worthwhile::streamed, [&](std::size_t b, std::size_t e, unsigned) {
        const std::size_t n = e - b;
        advance(m.x.subspan(b, n), m.vx.subspan(b, n), parameters_.gravityX, parameters_.dt);
        advance(m.y.subspan(b, n), m.vy.subspan(b, n), parameters_.gravityY, parameters_.dt);
    });
}

template <class Real>
void Stepper<Real>::countMissedPairs(const BodyView<Real>& bodies, Real reach, StepReport& report) {
    const auto start = std::chrono::steady_clock::now();
    const PairAudit audit = missedPairs_->count(bodies, partitioner_->partition(), reach);
    report.overlappingPairs += audit.overlapping;
    report.missedPairs += audit.missed;
    report.auditSeconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Real>
void Stepper<Real>::updatePartition(const BodyView<Real>& bodies, Real reach, StepReport& report) {
    const bool rebuilt = partitioner_->update(bodies, parameters_.dt, reach);
    report.rebuilt = report.rebuilt || rebuilt;
    // A skin notices a NaN as a body that left its box, so checking at builds sees every one; a
    // tree that is kept for so many steps, whatever happens, notices nothing.
    if (rebuilt || !partitioner_->partition().complete) requireFinite(bodies, *team_);
}

template <class Real>
void Stepper<Real>::step(World& world, std::uint64_t number, std::vector<ContactRecord>* records,
                         StepReport& report, bool profile) {
    const BodyView<Real> bodies = world.bodies<Real>();
    PhaseClock clock(report, profile);
    report.audited = missedPairs_ && missedPairs_->picks(number);
    const ResolveCounts counts = continuous_
                                     ? stepContinuous(bodies, number, records, report, clock)
                                     : stepDiscrete(bodies, number, records, report, clock);
    report.contacts = counts.contacts;
    report.collisions = counts.collisions;
    report.pairsTested = counts.pairsTested;
}

template <class Real>
ResolveCounts Stepper<Real>::stepDiscrete(const BodyView<Real>& bodies, std::uint64_t number,
                                          std::vector<ContactRecord>* records, StepReport& report,
                                          PhaseClock& clock) {
    parameters_.start = times_.at(number - 1);
    integrate(bodies);
    clock.finish(Phase::Integrate);
    onResolver(bodies, report,
               [&](Resolver<Real>& r) { r.integrated(bodies, parameters_, clock); });
    updatePartition(bodies, Real(0), report);
    clock.finish(Phase::Partition);
    if (report.audited) {
        countMissedPairs(bodies, Real(0), report);
        clock.restart();
    }
    const ResolveCounts counts = onResolver(bodies, report, [&](Resolver<Real>& r) {
        return r.resolve(bodies, partitioner_->partition(), parameters_, records);
    });
    clock.finish(Phase::Resolve);
    return counts;
}

template <class Real>
ResolveCounts Stepper<Real>::stepContinuous(const BodyView<Real>& bodies, std::uint64_t number,
                                            std::vector<ContactRecord>* records, StepReport& report,
                                            PhaseClock& clock) {
    const double start = times_.at(number - 1);
    const double end = times_.at(number);
    ResolveCounts counts;
    continuous_->anchor(bodies, start);
    clock.finish(Phase::Integrate);
    for (double now = start; now < end;) {
        const Real reach = continuous_->reach(bodies, now, end);
        updatePartition(bodies, reach, report);
        clock.finish(Phase::Partition);
        if (report.audited) {
            countMissedPairs(bodies, reach, report);
            clock.restart();
        }
        now = continuous_->advance(bodies, partitioner_->partition(), reach, now, end, records,
                                   counts);
        clock.finish(Phase::Resolve);
        if (!continuous_->place(bodies, now)) requireFinite(bodies, *team_);
        clock.finish(Phase::Integrate);
    }
    return counts;
}

template class Stepper<double>;
template class Stepper<float>;

}  // namespace quadrille
