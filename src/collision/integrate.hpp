#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include <quadrille/bodies.hpp>
#include <quadrille/error.hpp>

#include "collision/rules/discrete_motion.hpp"
#include "collision/rules/step_parameters.hpp"
#include "parallel/thread_team.hpp"

/// Loops over all bodies that several laws need on the host.

namespace quadrille {

/// Moves the bodies to the end of a step of a discrete law.
template <class Real>
void integrateAll(const MutableBodyView<Real>& bodies, const StepParameters<Real>& step,
                  const ThreadTeam& team) {
    const auto& m = bodies.moving;
    const auto advance = [&](Real* position, Real* velocity, Real gravity, std::size_t begin,
                             std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            integrate(position[i], velocity[i], gravity, step.dt);
        }
    };
    team.shares(m.size(), &Thresholds::streamed, [&](std::size_t b, std::size_t e, unsigned) {
        advance(m.x.data(), m.vx.data(), step.gravityX, b, e);
        advance(m.y.data(), m.vy.data(), step.gravityY, b, e);
    });
}

[[noreturn]] inline void failNotFinite(std::uint32_t entity) {
    throw Error("entity " + std::to_string(entity) + ": its position is no longer finite");
}

/// Stops a run before a NaN spreads: throws Error if a position is not finite.
template <class Real>
void requireFinite(const BodyView<Real>& bodies, const ThreadTeam& team) {
    const auto& m = bodies.moving;
    const Real* const x = m.x.data();
    const Real* const y = m.y.data();
    constexpr Real largest = std::numeric_limits<Real>::max();
    const bool anyBad =
        team.any(m.size(), &Thresholds::streamed, [&](std::size_t begin, std::size_t end) {
            int bad = 0;
            for (std::size_t i = begin; i < end; ++i) {
                bad |= !(std::abs(x[i]) <= largest) | !(std::abs(y[i]) <= largest);
            }
            return bad != 0;
        });
    if (!anyBad) return;
    for (std::size_t i = 0; i < m.size(); ++i) {
        if (!std::isfinite(x[i]) || !std::isfinite(y[i])) failNotFinite(m.entity[i]);
    }
}

}  // namespace quadrille
