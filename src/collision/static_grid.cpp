#include "collision/static_grid.hpp"

#include <cmath>
#include <limits>
#include <string>

#include <quadrille/error.hpp>

namespace quadrille {

namespace {

std::uint32_t cellsAlong(double world, double cell) {
    if (!std::isfinite(cell) || !(cell > 0)) {
        throw Error("static grid: the cell size must be finite and positive");
    }
    const double count = std::ceil(world / cell);
    constexpr double most = std::numeric_limits<std::uint16_t>::max() + 1.0;
    if (count > most) {
        throw Error("static grid: the cell size makes more than 65536 cells along an axis");
    }
    return count < 1 ? 1 : static_cast<std::uint32_t>(count);
}

}  // namespace

template <class Real>
StaticGridPartitioner<Real>::StaticGridPartitioner(const StaticGrid& config, const Vec2& worldSize)
    : columns_(cellsAlong(worldSize.x(), config.cellSize.x())),
      rows_(cellsAlong(worldSize.y(), config.cellSize.y())),
      grid_(-worldSize / 2, config.cellSize, columns_, rows_) {
    const std::uint64_t count = std::uint64_t(columns_) * rows_;
    if (count > std::numeric_limits<std::uint32_t>::max() / 16) {
        throw Error("static grid: the cell size makes " + std::to_string(count) + " cells");
    }
    Cells& cells = this->partition_.cells;
    cells.origin = -worldSize / 2;
    cells.fineCell = config.cellSize;
    cells.offsets.assign(count + 1, 0);
    cells.coordinates.resize(count);
    for (std::uint32_t y = 0; y < rows_; ++y) {
        for (std::uint32_t x = 0; x < columns_; ++x) {
            cells.coordinates[std::size_t(y) * columns_ + x] = {static_cast<std::uint16_t>(x),
                                                                static_cast<std::uint16_t>(y), 0};
        }
    }
}

template <class Real>
bool StaticGridPartitioner<Real>::update(const BodyView<Real>& bodies, Real, Real reach) {
    auto& partition = this->partition_;
    partition.margin = reach;
    auto& ranges = partition.ranges;
    auto& offsets = partition.cells.offsets;
    const std::size_t cellCount = partition.cells.size();
    grid_.ranges(bodies, reach, ranges);

    // Counting sort: counts, then the end of each cell, then a fill from the last body down that
    // leaves each cell in ascending order and offsets[c] at its start.
    std::fill(offsets.begin(), offsets.end(), 0);
    std::uint64_t entries = 0;
    for (const FineRange& r : ranges) {
        for (std::uint32_t y = r.y0; y <= r.y1; ++y) {
            std::uint32_t* row = offsets.data() + std::size_t(y) * columns_;
            for (std::uint32_t x = r.x0; x <= r.x1; ++x) ++row[x];
        }
        entries += std::uint64_t(r.x1 - r.x0 + 1) * (r.y1 - r.y0 + 1);
    }
    if (entries > std::numeric_limits<std::uint32_t>::max()) {
        throw Error("static grid: " + std::to_string(entries) +
                    " entries do not fit 32 bits; use larger cells");
    }
    std::uint32_t end = 0;
    for (std::size_t c = 0; c < cellCount; ++c) {
        end += offsets[c];
        offsets[c] = end;
    }
    offsets[cellCount] = end;
    partition.cells.bodies.resize(entries);
    std::uint32_t* out = partition.cells.bodies.data();
    for (std::size_t i = ranges.size(); i-- > 0;) {
        const FineRange& r = ranges[i];
        for (std::uint32_t y = r.y0; y <= r.y1; ++y) {
            std::uint32_t* row = offsets.data() + std::size_t(y) * columns_;
            for (std::uint32_t x = r.x0; x <= r.x1; ++x) {
                out[--row[x]] = static_cast<std::uint32_t>(i);
            }
        }
    }
    ++partition.generation;
    return true;
}

template class StaticGridPartitioner<double>;
template class StaticGridPartitioner<float>;

}  // namespace quadrille
