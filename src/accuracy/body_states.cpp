#include "accuracy/body_states.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <quadrille/creation_ranks.hpp>

namespace quadrille::accuracy {

std::vector<BodyState> statesOf(const World& world) {
    std::vector<BodyState> states;
    world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        states.reserve(m.size());
        const CreationRanks ranks(m.created, m.size());
        for (std::size_t place = 0; place < m.size(); ++place) {
            const std::size_t i = ranks.rowAt(place);
            states.push_back({Vec2(m.x[i], m.y[i]), Vec2(m.vx[i], m.vy[i])});
        }
    });
    return states;
}

double meanSide(const World& world) {
    double sum = 0;
    std::size_t count = 0;
    world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        count = m.size();
        // In order of creation, so that the sum does not depend on how the rows lie.
        const CreationRanks ranks(m.created, count);
        for (std::size_t place = 0; place < count; ++place) {
            const std::size_t i = ranks.rowAt(place);
            sum += double(m.halfWidth[i]) + double(m.halfHeight[i]);
        }
    });
    return count == 0 ? 1 : sum / double(count);
}

bool onlyExchanges(const Simulation& simulation) {
    const StepSettings& step = simulation.config().step;
    return step.restitution == 1 && step.gravity == Vec2(0, 0) &&
           !simulation.features().massesDiffer;
}

double velocityTolerance(bool exchanged, Precision precision, double fastest) {
    if (exchanged) return 0;
    const double epsilon = precision == Precision::Double
                               ? std::numeric_limits<double>::epsilon()
                               : double(std::numeric_limits<float>::epsilon());
    return std::sqrt(epsilon) * fastest;
}

double fastestComponent(std::span<const BodyState> states) {
    double fastest = 0;
    for (const BodyState& body : states) {
        fastest = std::max(fastest, body.velocity.cwiseAbs().maxCoeff());
    }
    return fastest;
}

}  // namespace quadrille::accuracy
