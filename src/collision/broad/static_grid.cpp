#include "collision/broad/static_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <quadrille/error.hpp>

#include "collision/broad/body_ranges.hpp"

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

void requireCountable(std::uint64_t entries) {
    if (entries <= std::numeric_limits<std::uint32_t>::max()) return;
    throw Error("static grid: " + std::to_string(entries) +
                " entries do not fit 32 bits; use larger cells");
}

}  // namespace

GridShape gridShape(const StaticGrid& config, const Vec2& worldSize) {
    const GridShape shape{cellsAlong(worldSize.x(), config.cellSize.x()),
                          cellsAlong(worldSize.y(), config.cellSize.y())};
    const std::uint64_t count = std::uint64_t(shape.columns) * shape.rows;
    if (count > std::numeric_limits<std::uint32_t>::max() / 16) {
        throw Error("static grid: the cell size makes " + std::to_string(count) + " cells");
    }
    return shape;
}

template <class Real>
StaticGridPartitioner<Real>::StaticGridPartitioner(const StaticGrid& config, const Vec2& worldSize,
                                                   const ThreadTeam& team)
    : columns_(gridShape(config, worldSize).columns),
      rows_(gridShape(config, worldSize).rows),
      team_(team) {
    const std::size_t count = std::size_t(columns_) * rows_;
    this->partition_.grid = makeFineGrid<Real>(-worldSize / 2, config.cellSize, columns_, rows_);
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
bool StaticGridPartitioner<Real>::update(const BodyView<Real>& bodies, Real,
                                         const Reach<Real>& reach) {
    auto& partition = this->partition_;
    const std::size_t count = bodies.size();
    partition.beginBuild(bodies, reach, 0);
    const unsigned workers = team_.workersFor(count, &Thresholds::built);
    if (workers == 1) {
        findRanges(partition, bodies, 0, count);
        const Strip all{0, rows_};
        const auto body = [](std::size_t i) { return static_cast<std::uint32_t>(i); };
        reserveEntries(countRows(all, count, body));
        fillRows(all, count, body, 0);
    } else {
        layStrips(workers);
        sortIntoStrips(bodies, workers);
        const auto membersOf = [&](const Strip& strip) {
            return [this, first = strip.firstMember](std::size_t i) { return members_[first + i]; };
        };
        team_.run(workers, [&](unsigned worker) {
            Strip& strip = strips_[worker];
            strip.entries =
                countRows(strip, strip.lastMember - strip.firstMember, membersOf(strip));
        });
        std::uint64_t entries = 0;
        for (const Strip& strip : strips_) entries += strip.entries;
        reserveEntries(entries);
        team_.run(workers, [&](unsigned worker) {
            const Strip& strip = strips_[worker];
            std::uint64_t before = 0;
            for (unsigned w = 0; w < worker; ++w) before += strips_[w].entries;
            fillRows(strip, strip.lastMember - strip.firstMember, membersOf(strip),
                     static_cast<std::uint32_t>(before));
        });
    }
    ++partition.generation;
    return true;
}

/// Makes strips of whole rows that had about as many entries each in the last step.
template <class Real>
void StaticGridPartitioner<Real>::layStrips(std::size_t count) {
    const auto& offsets = this->partition_.cells.offsets;
    const std::uint64_t entries = offsets.back();
    const auto before = [&](std::uint32_t row) -> std::uint64_t {
        return entries > 0 ? offsets[std::size_t(row) * columns_] : row;
    };
    const std::uint64_t total = before(rows_);
    strips_.clear();
    stripOfRow_.resize(rows_);
    std::uint32_t row = 0;
    for (std::size_t s = 0; s < count; ++s) {
        const std::uint32_t first = row;
        while (row < rows_ && (s + 1 == count || before(row) < total * (s + 1) / count)) {
            stripOfRow_[row++] = static_cast<std::uint32_t>(s);
        }
        strips_.push_back({first, row});
    }
}

/// Finds the ranges of all bodies, and for each strip its bodies.
template <class Real>
void StaticGridPartitioner<Real>::sortIntoStrips(const BodyView<Real>& bodies, unsigned workers) {
    auto& partition = this->partition_;
    FineRange* const ranges = partition.ranges.data();
    const std::size_t count = bodies.size();
    const std::size_t stride = strips_.size() + 16;  // keeps the workers' counts a line apart
    places_.resize(workers * stride);
    team_.run(workers, [&](unsigned worker) {
        const std::size_t begin = count * worker / workers;
        const std::size_t end = count * (worker + 1) / workers;
        std::uint32_t* const found = places_.data() + worker * stride;
        std::fill(found, found + strips_.size(), 0);
        findRanges(partition, bodies, begin, end);
        for (std::size_t i = begin; i < end; ++i) {
            forEachStrip(ranges[i], [&](std::size_t s) { ++found[s]; });
        }
    });
    std::uint64_t place = 0;
    for (std::size_t s = 0; s < strips_.size(); ++s) {
        strips_[s].firstMember = static_cast<std::size_t>(place);
        for (unsigned worker = 0; worker < workers; ++worker) {
            std::uint32_t& places = places_[worker * stride + s];
            place += std::exchange(places, static_cast<std::uint32_t>(place));
        }
        strips_[s].lastMember = static_cast<std::size_t>(place);
    }
    requireCountable(place);
    members_.resize(static_cast<std::size_t>(place));
    team_.run(workers, [&](unsigned worker) {
        const std::size_t begin = count * worker / workers;
        const std::size_t end = count * (worker + 1) / workers;
        std::uint32_t* const places = places_.data() + worker * stride;
        for (std::size_t i = begin; i < end; ++i) {
            forEachStrip(ranges[i], [&](std::size_t s) {
                members_[places[s]++] = static_cast<std::uint32_t>(i);
            });
        }
    });
}

template <class Real>
void StaticGridPartitioner<Real>::reserveEntries(std::uint64_t entries) {
    requireCountable(entries);
    Cells& cells = this->partition_.cells;
    cells.bodies.resize(static_cast<std::size_t>(entries));
    cells.offsets.back() = static_cast<std::uint32_t>(entries);
}

/// Counts the members of the strip's cells, in their offsets. Returns how many there are in all.
template <class Real>
template <class Member>
std::uint64_t StaticGridPartitioner<Real>::countRows(const Strip& strip, std::size_t count,
                                                     Member&& member) {
    const FineRange* const ranges = this->partition_.ranges.data();
    std::uint32_t* const offsets = this->partition_.cells.offsets.data();
    std::fill(offsets + std::size_t(strip.firstRow) * columns_,
              offsets + std::size_t(strip.lastRow) * columns_, 0);
    std::uint64_t entries = 0;
    for (std::size_t i = 0; i < count; ++i) {
        forEachCell(strip, ranges[member(i)], [&](std::size_t cell) {
            ++offsets[cell];
            ++entries;
        });
    }
    return entries;
}

/// Turns the counts into the end of each cell, and fills from the last member down, which leaves
/// each cell in ascending order and its offset at its start. The first entry goes to `begin`.
template <class Real>
template <class Member>
void StaticGridPartitioner<Real>::fillRows(const Strip& strip, std::size_t count, Member&& member,
                                           std::uint32_t begin) {
    const FineRange* const ranges = this->partition_.ranges.data();
    std::uint32_t* const offsets = this->partition_.cells.offsets.data();
    BodyRef* const bodies = this->partition_.cells.bodies.data();
    std::uint32_t end = begin;
    for (std::size_t c = std::size_t(strip.firstRow) * columns_;
         c < std::size_t(strip.lastRow) * columns_; ++c) {
        offsets[c] = end += offsets[c];
    }
    for (std::size_t i = count; i-- > 0;) {
        const std::uint32_t place = member(i);
        const BodyRef body = this->partition_.bodyAt(place);
        forEachCell(strip, ranges[place],
                    [&](std::size_t cell) { bodies[--offsets[cell]] = body; });
    }
}

template <class Real>
template <class Function>
void StaticGridPartitioner<Real>::forEachCell(const Strip& strip, const FineRange& range,
                                              Function&& function) const {
    const std::uint32_t first = std::max<std::uint32_t>(range.y0, strip.firstRow);
    const std::uint32_t end = std::min<std::uint32_t>(range.y1 + 1u, strip.lastRow);
    for (std::uint32_t y = first; y < end; ++y) {
        const std::size_t row = std::size_t(y) * columns_;
        for (std::uint32_t x = range.x0; x <= range.x1; ++x) function(row + x);
    }
}

template <class Real>
template <class Function>
void StaticGridPartitioner<Real>::forEachStrip(const FineRange& range, Function&& function) const {
    const std::uint32_t last = stripOfRow_[range.y1];
    for (std::uint32_t s = stripOfRow_[range.y0]; s <= last; ++s) function(s);
}

template <class Real>
std::size_t StaticGridPartitioner<Real>::bytes() const {
    return this->partition_.bytes() + strips_.capacity() * sizeof(Strip) +
           (stripOfRow_.capacity() + places_.capacity() + members_.capacity()) *
               sizeof(std::uint32_t);
}

template class StaticGridPartitioner<double>;
template class StaticGridPartitioner<float>;

}  // namespace quadrille
