#include "accuracy/error_meter.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <quadrille/creation_ranks.hpp>
#include <quadrille/error.hpp>
#include <quadrille/measure.hpp>

#include "accuracy/body_states.hpp"
#include "accuracy/virial.hpp"
#include "reference/oracle.hpp"

namespace quadrille::accuracy {

namespace {

using reference::Box;
using reference::Oracle;
using reference::Ties;

/// Static bodies first: their order among themselves is all that the reference's ids need.
std::vector<Box> boxesOf(const World& world) {
    std::vector<Box> boxes;
    world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        const auto& f = bodies.fixed;
        boxes.reserve(bodies.size());
        const CreationRanks ranksOfStatic(f.created, f.size());
        for (std::size_t place = 0; place < f.size(); ++place) {
            const std::size_t k = ranksOfStatic.rowAt(place);
            boxes.push_back({.position = Vec2(f.x[k], f.y[k]),
                             .size = 2 * Vec2(f.halfWidth[k], f.halfHeight[k]),
                             .isStatic = true,
                             .label = f.entity[k]});
        }
        const CreationRanks ranks(m.created, m.size());
        for (std::size_t place = 0; place < m.size(); ++place) {
            const std::size_t i = ranks.rowAt(place);
            boxes.push_back({.position = Vec2(m.x[i], m.y[i]),
                             .velocity = Vec2(m.vx[i], m.vy[i]),
                             .size = 2 * Vec2(m.halfWidth[i], m.halfHeight[i]),
                             .mass = static_cast<double>(m.mass[i]),
                             .label = m.entity[i]});
        }
    });
    return boxes;
}

/// Calls `action`; what the reference throws becomes an Error that says whose it is.
template <class Action>
auto inReference(Action&& action) {
    try {
        return action();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw Error(
            std::string("reference: ") + error.what() +
            " (bodies that overlap at the start can be wedged so that no motion frees them)");
    } catch (const std::exception& error) {
        throw Error(std::string("reference: ") + error.what());
    }
}

/// Overlaps of several states.
struct OverlapSum {
    double max = 0, sum = 0;  // px
    std::size_t pairs = 0;

    void add(const World& world) {
        const Overlap now = overlap(world);
        max = std::max(max, now.max);
        sum += now.mean * double(now.pairs);
        pairs += now.pairs;
    }
    double mean() const { return pairs == 0 ? 0 : sum / double(pairs); }
};

/// Energy in uniform gravity, and the kinetic part of it.
struct Energy {
    double total = 0, kinetic = 0;
};

}  // namespace

struct ErrorMeter::Impl {
    explicit Impl(Simulation& s)
        : simulation(s),
          boxes(boxesOf(s.world())),
          oracle(inReference([&] {
              return Oracle(boxes, s.config().step.gravity, s.config().step.restitution,
                            Ties::ByLabels);
          })),
          begin(s.time()),
          start(statesOf(s.world())),
          length(meanSide(s.world())),
          exchanged(onlyExchanges(s)) {
        const bool elastic =
            s.config().step.restitution == 1 && s.config().step.gravity == Vec2(0, 0);
        if (elastic) balance.emplace(s.world());
    }

    void observe(const StepReport& report);
    Energy energyOf(const std::vector<BodyState>& states) const;
    std::vector<BodyState> exactStates() const;

    Simulation& simulation;
    std::vector<Box> boxes;  // at the start, static ones first
    Oracle oracle;
    double begin;  // s, when the meter was made; time 0 of the reference
    std::vector<BodyState> start;
    double length;                         // px
    bool exchanged;                        // collisions exchange velocities and change nothing else
    std::optional<VirialBalance> balance;  // where the identity holds
    std::vector<Event> measured;           // times from `begin`
    std::uint64_t auditedSteps = 0, overlappingPairs = 0, missedPairs = 0;
    OverlapSum overlaps;         // of audited steps
    bool overlapsKnown = false;  // of the present state
};

ErrorMeter::ErrorMeter(Simulation& simulation) : impl_(std::make_unique<Impl>(simulation)) {
    simulation.onContact([impl = impl_.get()](const Contact& contact) {
        if (!contact.collided) return;
        impl->measured.push_back({contact.time - impl->begin, contact.numberA, contact.numberB,
                                  static_cast<int>(contact.axis)});
        if (impl->balance) impl->balance->collide(contact);
    });
    simulation.onStep(
        [impl = impl_.get()](const World&, const StepReport& report) { impl->observe(report); });
}

ErrorMeter::~ErrorMeter() = default;

void ErrorMeter::Impl::observe(const StepReport& report) {
    const World& world = simulation.world();
    if (balance) balance->finishStep(world, simulation.config().step.dt);
    overlapsKnown = report.audited;
    if (!report.audited) return;
    ++auditedSteps;
    overlappingPairs += report.overlappingPairs;
    missedPairs += report.missedPairs;
    overlaps.add(world);
}

void ErrorMeter::follow() {
    inReference([&] { impl_->oracle.runUntil(impl_->simulation.time() - impl_->begin); });
}

std::vector<BodyState> ErrorMeter::Impl::exactStates() const {
    std::vector<BodyState> states;
    for (const Box& box : oracle.state()) {
        if (!box.isStatic) states.push_back({box.position, box.velocity});
    }
    return states;
}

Energy ErrorMeter::Impl::energyOf(const std::vector<BodyState>& states) const {
    Energy energy;
    const std::size_t fixed = boxes.size() - states.size();
    for (std::size_t i = 0; i < states.size(); ++i) {
        const double mass = boxes[fixed + i].mass;
        const double kinetic = mass * states[i].velocity.squaredNorm() / 2;
        energy.kinetic += kinetic;
        energy.total += kinetic - mass * simulation.config().step.gravity.dot(states[i].position);
    }
    return energy;
}

ErrorMetrics ErrorMeter::metrics() const {
    const Impl& m = *impl_;
    const std::vector<BodyState> measured = statesOf(m.simulation.world());
    if (measured.size() != m.start.size()) {
        throw Error("error meter: bodies were added or removed");
    }
    const std::vector<BodyState> exact = m.exactStates();
    const double tolerance =
        velocityTolerance(m.exchanged, m.simulation.config().precision,
                          std::max(fastestComponent(m.start), fastestComponent(exact)));
    OverlapSum overlaps = m.overlaps;
    if (!m.overlapsKnown) overlaps.add(m.simulation.world());
    ErrorMetrics result{
        .horizon = m.oracle.time(),
        .events = matchEvents(m.oracle.events(), m.measured, 2 * m.simulation.config().step.dt),
        .pushedCollisions = m.oracle.choices().pushed,
        .jammedCollisions = m.oracle.choices().jammed,
        .bodies = exact.size(),
        .wrongBodies = wrongBodies(exact, measured, tolerance),
        .velocityTolerance = tolerance,
        .positionError = positionErrors(exact, measured, m.length),
        .length = m.length,
        .escaped = escaped(m.simulation.world()),
        .overlapMax = overlaps.max / m.length,
        .overlapMean = overlaps.mean() / m.length,
        .speedDrift = {},
        .wallIdentity = {},
        .auditedSteps = m.auditedSteps,
        .overlappingPairs = m.overlappingPairs,
        .missedPairs = m.missedPairs};
    const Energy energyStart = m.energyOf(m.start);
    const Energy energyExact = m.energyOf(exact);
    const double excess = m.energyOf(measured).total - energyExact.total;
    if (excess != 0) {
        result.energyDrift = excess / std::max(energyStart.kinetic, energyExact.kinetic);
    }
    if (m.exchanged) result.speedDrift = speedDrift(m.start, measured);
    if (m.balance) result.wallIdentity = m.balance->residual();
    return result;
}

}  // namespace quadrille::accuracy
