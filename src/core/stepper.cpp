#include "core/stepper.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include <quadrille/error.hpp>

#include "collision/motion.hpp"

namespace quadrille {

namespace {

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
void requireFinite(const BodyView<Real>& bodies) {
    const auto& m = bodies.moving;
    const Real* const x = m.x.data();
    const Real* const y = m.y.data();
    constexpr Real largest = std::numeric_limits<Real>::max();
    int bad = 0;
    for (std::size_t i = 0; i < m.size(); ++i) {
        bad |= !(std::abs(x[i]) <= largest) | !(std::abs(y[i]) <= largest);
    }
    if (bad == 0) return;
    for (std::size_t i = 0; i < m.size(); ++i) {
        if (!std::isfinite(x[i]) || !std::isfinite(y[i])) {
            throw Error("entity " + std::to_string(m.entity[i]) +
                        ": its position is no longer finite");
        }
    }
}

}  // namespace

template <class Real>
Stepper<Real>::Stepper(const SimulationConfig& config, const Vec2& worldSize)
    : parameters_{0, static_cast<Real>(config.dt), static_cast<Real>(config.gravity.x()),
                  static_cast<Real>(config.gravity.y()), static_cast<Real>(config.restitution)},
      times_(config.dt) {
    setPartitioner(config, worldSize);
    if (config.countMissedPairs) {
        missedPairs_ = std::make_unique<MissedPairCounter<Real>>(worldSize);
    }
}

template <class Real>
void Stepper<Real>::setPartitioner(const SimulationConfig& config, const Vec2& worldSize) {
    // The resolver remembers pairs of the partition that it saw last, so both are replaced.
    auto partitioner = makePartitioner<Real>(config.partitioner, worldSize);
    if (config.law == Law::Continuous) {
        if (!partitioner->partition().complete) {
            throw NotAvailable("the law 'continuous' needs a partition that misses no pair");
        }
        if (config.resolver != ResolverKind::Sequential) {
            throw NotAvailable("the law 'continuous' runs on the resolver 'sequential'");
        }
        if (config.gravity != Vec2(0, 0) || config.restitution != 1) {
            throw NotAvailable(
                "the law 'continuous' knows no gravity and no restitution below 1 yet");
        }
        continuous_ = std::make_unique<SequentialContinuous<Real>>();
    } else {
        try {
            resolver_ = makeResolver<Real>(config);
        } catch (const DeviceError& failure) {
            if (!config.fallback) throw;
            useSequential(config, failure);
        }
    }
    partitioner_ = std::move(partitioner);
    config_ = config;
    worldSize_ = worldSize;
}

template <class Real>
void Stepper<Real>::useSequential(SimulationConfig config, const DeviceError& failure) {
    config.resolver = ResolverKind::Sequential;
    resolver_ = makeResolver<Real>(config);
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
        partitioner_ = makePartitioner<Real>(config_.partitioner, worldSize_);
        updatePartition(bodies, Real(0), report);
    }
    return function(*resolver_);
}

template <class Real>
void Stepper<Real>::integrate(const BodyView<Real>& bodies) const {
    advance(bodies.moving.x, bodies.moving.vx, parameters_.gravityX, parameters_.dt);
    advance(bodies.moving.y, bodies.moving.vy, parameters_.gravityY, parameters_.dt);
}

template <class Real>
void Stepper<Real>::countMissedPairs(const BodyView<Real>& bodies, StepReport& report) {
    const auto start = std::chrono::steady_clock::now();
    report.missedPairs = missedPairs_->count(bodies, partitioner_->partition());
    report.auditSeconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class Real>
void Stepper<Real>::updatePartition(const BodyView<Real>& bodies, Real reach, StepReport& report) {
    const bool rebuilt = partitioner_->update(bodies, parameters_.dt, reach);
    report.rebuilt = report.rebuilt || rebuilt;
    // A skin notices a NaN as a body that left its box, so checking at builds sees every one; a
    // tree that is kept for so many steps, whatever happens, notices nothing.
    if (rebuilt || !partitioner_->partition().complete) requireFinite(bodies);
}

template <class Real>
void Stepper<Real>::step(World& world, std::uint64_t number, std::vector<ContactRecord>* records,
                         StepReport& report, bool profile) {
    const BodyView<Real> bodies = world.bodies<Real>();
    PhaseClock clock(report, profile);
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
    if (missedPairs_) {
        countMissedPairs(bodies, report);
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
        now = continuous_->advance(bodies, partitioner_->partition(), reach, now, end, records,
                                   counts);
        clock.finish(Phase::Resolve);
        continuous_->place(bodies, now);
        clock.finish(Phase::Integrate);
    }
    return counts;
}

template class Stepper<double>;
template class Stepper<float>;

}  // namespace quadrille
