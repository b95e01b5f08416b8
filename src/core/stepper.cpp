#include "core/stepper.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include <quadrille/error.hpp>

namespace quadrille {

namespace {

/// Measures the phases of a step one after the other; does nothing unless asked to.
class PhaseClock {
  public:
    using Clock = std::chrono::steady_clock;

    PhaseClock(StepReport& report, bool enabled) : report_(report), enabled_(enabled) {
        if (enabled_) last_ = Clock::now();
    }
    void finish(Phase phase) {
        if (!enabled_) return;
        const auto now = Clock::now();
        report_.phaseSeconds[static_cast<std::size_t>(phase)] =
            std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

    /// Leaves out what happened since the last phase.
    void restart() {
        if (enabled_) last_ = Clock::now();
    }

  private:
    StepReport& report_;
    bool enabled_;
    Clock::time_point last_;
};

template <class Real>
void advance(std::span<Real> position, std::span<Real> velocity, Real gravity, Real dt) {
    Real* const p = position.data();
    Real* const v = velocity.data();
    const std::size_t count = position.size();
    if (gravity != 0) {
        const Real change = gravity * dt;
        for (std::size_t i = 0; i < count; ++i) v[i] += change;
    }
    for (std::size_t i = 0; i < count; ++i) p[i] += v[i] * dt;
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
    : parameters_{static_cast<Real>(config.dt), static_cast<Real>(config.gravity.x()),
                  static_cast<Real>(config.gravity.y()), static_cast<Real>(config.restitution)} {
    setPartitioner(config, worldSize);
    if (config.countMissedPairs) {
        missedPairs_ = std::make_unique<MissedPairCounter<Real>>(worldSize);
    }
}

template <class Real>
void Stepper<Real>::setPartitioner(const SimulationConfig& config, const Vec2& worldSize) {
    // The resolver remembers pairs of the partition that it saw last, so both are replaced.
    auto partitioner = makePartitioner<Real>(config.partitioner, worldSize);
    resolver_ = makeResolver<Real>(config.resolver, config.law);
    partitioner_ = std::move(partitioner);
}

template <class Real>
void Stepper<Real>::integrate(const BodyView<Real>& bodies) const {
    advance(bodies.moving.x, bodies.moving.vx, parameters_.gravityX, parameters_.dt);
    advance(bodies.moving.y, bodies.moving.vy, parameters_.gravityY, parameters_.dt);
}

template <class Real>
void Stepper<Real>::countMissedPairs(const BodyView<Real>& bodies, StepReport& report) {
    const auto start = PhaseClock::Clock::now();
    report.missedPairs = missedPairs_->count(bodies, partitioner_->partition());
    report.auditSeconds = std::chrono::duration<double>(PhaseClock::Clock::now() - start).count();
}

template <class Real>
void Stepper<Real>::step(World& world, std::vector<ContactRecord>* records, StepReport& report,
                         bool profile) {
    const BodyView<Real> bodies = world.bodies<Real>();
    PhaseClock clock(report, profile);
    integrate(bodies);
    clock.finish(Phase::Integrate);

    report.rebuilt = partitioner_->update(bodies, parameters_.dt);
    // A skin notices a NaN as a body that left its box, so checking at builds sees every one; a
    // tree that is kept for so many steps, whatever happens, notices nothing.
    if (report.rebuilt || !partitioner_->partition().complete) requireFinite(bodies);
    clock.finish(Phase::Partition);
    if (missedPairs_) {
        countMissedPairs(bodies, report);
        clock.restart();
    }

    const ResolveCounts counts =
        resolver_->resolve(bodies, partitioner_->partition(), parameters_, records);
    clock.finish(Phase::Resolve);
    report.contacts = counts.contacts;
    report.collisions = counts.collisions;
    report.pairsTested = counts.pairsTested;
}

template class Stepper<double>;
template class Stepper<float>;

}  // namespace quadrille
