#include "app/window/nice_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace quadrille::app {

double niceCeiling(double value) {
    if (!(value > 0)) return 0;
    const double power = std::pow(10, std::floor(std::log10(value)));
    // A value that is nice itself, but for rounding, is its own ceiling.
    for (const double step : {1.0, 2.0, 5.0}) {
        if (value <= step * power * (1 + 1e-6)) return step * power;
    }
    return 10 * power;
}

double percentile(std::vector<float>& values, double share) {
    if (values.empty()) return 0;
    const double rank = std::ceil(std::clamp(share, 0.0, 1.0) * double(values.size()));
    const auto place = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return double(values[static_cast<std::size_t>(place)]);
}

}  // namespace quadrille::app
