#pragma once

#include <algorithm>
#include <cmath>

#include <quadrille/error.hpp>
#include <quadrille/simulation.hpp>

namespace quadrille::fuzz {

/// Whether a step ends soon. One of the law `continuous` takes as long as the events in it, and a
/// body that crosses the world 1e60 times has as many.
inline bool isShort(const Simulation& sim) {
    const auto& step = sim.config().step;
    if (sim.config().law != Law::Continuous) return true;
    double fastest = step.gravity.lpNorm<Eigen::Infinity>() * step.dt;
    sim.world().visitBodies([&](const auto& bodies) {
        for (std::size_t i = 0; i < bodies.moving.size(); ++i) {
            fastest = std::max({fastest, std::abs(double(bodies.moving.vx[i])),
                                std::abs(double(bodies.moving.vy[i]))});
        }
    });
    return step.dt < 10 && fastest * step.dt < 1e4;
}

/// A run that was accepted may still leave the numbers that a double has, and says so.
inline bool runs(Simulation& sim) {
    try {
        sim.run(2);
        return true;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace quadrille::fuzz
