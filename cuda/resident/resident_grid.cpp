#include "cuda/resident/resident_grid.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace quadrille::cuda {

template <class Real>
double meanExtent(const BodyView<Real>& bodies) {
    if (bodies.moving.size() == 0) return 0;
    const auto mean = [&](const ColumnView<Real>& half) {
        if (half.uniform()) return 2 * static_cast<double>(half.common);
        double sum = 0;
        for (const Real value : half.values) sum += static_cast<double>(value);
        return 2 * sum / static_cast<double>(half.values.size());
    };
    return std::max(mean(bodies.moving.halfWidth), mean(bodies.moving.halfHeight));
}

StaticGrid gridFor(const PartitionerConfig& config, std::size_t moving, double extent,
                   const Vec2& worldSize) {
    if (const auto* grid = std::get_if<StaticGrid>(&config)) return *grid;
    constexpr double cellsPerBody = 4, fewest = 1024, mostAlongAnAxis = 65'000;
    const double most = cellsPerBody * static_cast<double>(moving) + fewest;
    double side = moving > 0 ? 2 * extent : worldSize.maxCoeff();
    side = std::max({side, std::sqrt(worldSize.x() * worldSize.y() / most),
                     worldSize.maxCoeff() / std::min(mostAlongAnAxis, most)});
    return {{side, side}};
}

template double meanExtent(const BodyView<double>&);
template double meanExtent(const BodyView<float>&);

}  // namespace quadrille::cuda
