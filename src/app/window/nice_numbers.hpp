#pragma once

#include <vector>

namespace quadrille::app {

/// The next of 1, 2, 5, 10, 20, ... times a power of ten that is not below `value`, for the end of
/// a scale; 0 for what is not above 0.
double niceCeiling(double value);

/// The value that the given share of all is not above; 0 of none. Changes their order.
double percentile(std::vector<float>& values, double share);

}  // namespace quadrille::app
