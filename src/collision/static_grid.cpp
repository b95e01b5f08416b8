#include "collision/static_grid.hpp"

#include <algorithm>
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
StaticGridPartitioner<Real>::StaticGridPartitioner(const StaticGrid& config, const Vec2& worldSize,
                                                   const ThreadTeam& team)
    : columns_(cellsAlong(worldSize.x(), config.cellSize.x())),
      rows_(cellsAlong(worldSize.y(), config.cellSize.y())),
      grid_(-worldSize / 2, config.cellSize, columns_, rows_),
      team_(team) {
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
    grid_.ranges(bodies, reach, partition.ranges, team_);
    if (team_.workersFor(bodies.size(), worthwhile::built) == 1) {
        fill();
    } else {
        fillInParallel();
    }
    ++partition.generation;
    return true;
}

template <class Real>
void StaticGridPartitioner<Real>::requireCountable(std::uint64_t entries) const {
    if (entries <= std::numeric_limits<std::uint32_t>::max()) return;
    throw Error("static grid: " + std::to_string(entries) +
                " entries do not fit 32 bits; use larger cells");
}

/// Counting sort: counts, then the end of each cell, then a fill from the last body down that
/// leaves each cell in ascending order and offsets[c] at its start.
template <class Real>
void StaticGridPartitioner<Real>::fill() {
    const auto& ranges = this->partition_.ranges;
    Cells& cells = this->partition_.cells;
    auto& offsets = cells.offsets;
    std::fill(offsets.begin(), offsets.end(), 0);
    std::uint64_t entries = 0;
    for (const FineRange& r : ranges) {
        forEachCell(r, [&](std::size_t cell) { ++offsets[cell]; });
        entries += std::uint64_t(r.x1 - r.x0 + 1) * (r.y1 - r.y0 + 1);
    }
    requireCountable(entries);
    std::uint32_t end = 0;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        end += offsets[c];
        offsets[c] = end;
    }
    offsets.back() = end;
    cells.bodies.resize(entries);
    for (std::size_t i = ranges.size(); i-- > 0;) {
        forEachCell(ranges[i], [&](std::size_t cell) {
            cells.bodies[--offsets[cell]] = static_cast<std::uint32_t>(i);
        });
    }
}

/// The same with a count that all threads advance; bodies come to a cell in any order and are
/// sorted there.
template <class Real>
void StaticGridPartitioner<Real>::fillInParallel() {
    const auto& ranges = this->partition_.ranges;
    Cells& cells = this->partition_.cells;
    const std::size_t cellCount = cells.size();
    if (!cursors_) cursors_ = std::make_unique<std::atomic<std::uint32_t>[]>(cellCount);
    std::atomic<std::uint64_t> total{0};
    team_.shares(cellCount, worthwhile::streamed, [&](std::size_t b, std::size_t e, unsigned) {
        for (std::size_t c = b; c < e; ++c) cursors_[c].store(0, std::memory_order_relaxed);
    });
    team_.shares(ranges.size(), worthwhile::built, [&](std::size_t b, std::size_t e, unsigned) {
        std::uint64_t entries = 0;
        for (std::size_t i = b; i < e; ++i) {
            forEachCell(ranges[i], [&](std::size_t cell) {
                cursors_[cell].fetch_add(1, std::memory_order_relaxed);
                ++entries;
            });
        }
        total.fetch_add(entries, std::memory_order_relaxed);
    });
    requireCountable(total);
    std::uint32_t start = 0;
    for (std::size_t c = 0; c < cellCount; ++c) {
        cells.offsets[c] = start;
        start += cursors_[c].load(std::memory_order_relaxed);
        cursors_[c].store(cells.offsets[c], std::memory_order_relaxed);
    }
    cells.offsets.back() = start;
    cells.bodies.resize(total);
    team_.shares(ranges.size(), worthwhile::built, [&](std::size_t b, std::size_t e, unsigned) {
        for (std::size_t i = b; i < e; ++i) {
            forEachCell(ranges[i], [&](std::size_t cell) {
                cells.bodies[cursors_[cell].fetch_add(1, std::memory_order_relaxed)] =
                    static_cast<std::uint32_t>(i);
            });
        }
    });
    team_.shares(cellCount, worthwhile::built, [&](std::size_t b, std::size_t e, unsigned) {
        for (std::size_t c = b; c < e; ++c) {
            std::sort(cells.bodies.data() + cells.offsets[c],
                      cells.bodies.data() + cells.offsets[c + 1]);
        }
    });
}

template <class Real>
std::size_t StaticGridPartitioner<Real>::bytes() const {
    const std::size_t cursors = cursors_ ? this->partition_.cells.size() : 0;
    return this->partition_.bytes() + cursors * sizeof(std::uint32_t);
}

template class StaticGridPartitioner<double>;
template class StaticGridPartitioner<float>;

}  // namespace quadrille
