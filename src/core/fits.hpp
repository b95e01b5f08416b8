#pragma once

#include <cmath>

namespace quadrille {

/// Whether the number stays finite, and positive if it has to be, when it is stored as Real: one
/// that overflows or vanishes would silently change a body.
template <class Real>
bool fits(double value, bool positive) {
    const auto result = static_cast<Real>(value);
    return std::isfinite(result) && (!positive || result > 0);
}

}  // namespace quadrille
