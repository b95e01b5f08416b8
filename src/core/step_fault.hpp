#pragma once

#include <cmath>

#include <quadrille/config.hpp>

namespace quadrille {

/// Why no run in this precision can have these settings, or null.
inline const char* stepFault(const StepSettings& step, Precision precision) {
    if (!(std::isfinite(step.dt) && step.dt > 0)) return "dt must be finite and positive";
    if (!step.gravity.allFinite()) return "gravity must be finite";
    if (precision == Precision::Float) {
        const auto dt = static_cast<float>(step.dt);
        if (!(std::isfinite(dt) && dt > 0)) return "dt does not fit single precision";
        if (!step.gravity.cast<float>().allFinite()) return "gravity does not fit single precision";
    }
    if (!(step.restitution >= 0 && step.restitution <= 1)) return "restitution must be from 0 to 1";
    return nullptr;
}

}  // namespace quadrille
