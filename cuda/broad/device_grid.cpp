#include "cuda/broad/device_grid.hpp"

#include <algorithm>

#include <quadrille/error.hpp>

#include "collision/broad/body_ranges.hpp"
#include "collision/broad/static_grid.hpp"

namespace quadrille::cuda {

namespace {

void requireCounted(std::uint32_t entries) {
    if (entries != none) return;
    throw Error("static grid: the entries do not fit 32 bits; use larger cells");
}

}  // namespace

template <class Real>
void DeviceGrid<Real>::lay(const StaticGrid& config, const Vec2& worldSize) {
    fixedListed_ = false;
    if (count_ > 0 && config.cellSize == cellSize_) return;
    const auto [columns, rows] = gridShape(config, worldSize);
    count_ = 0;
    device_.reserveZeroed(coordinates_, std::size_t(columns) * rows);
    offsets_.reserve(std::size_t(columns) * rows + 1);
    badRow_.reserve(1);
    origin_ = -worldSize / 2;
    cellSize_ = config.cellSize;
    columns_ = columns;
    grid_ = makeFineGrid<Real>(origin_, cellSize_, columns, rows);
    const std::uint32_t count = columns * rows;
    layCoordinates(device_.launch(), coordinates_.data(), columns_, count);
    sumCounts(device_.launch(), nullptr, scratchBytes_, offsets_.data(), count);
    scratch_.reserve(scratchBytes_);
    count_ = count;
}

template <class Real>
GridInput<Real> DeviceGrid<Real>::moving() const {
    return {bodies_.bodies(), bodies_.movingCount(), 0, grid_, columns_, margin_};
}

template <class Real>
GridInput<Real> DeviceGrid<Real>::fixed() const {
    return {bodies_.bodies(), 0, bodies_.fixedCount(), grid_, columns_, margin_};
}

/// Static bodies are in the same cells in every sort.
template <class Real>
void DeviceGrid<Real>::listFixed() {
    fixedEntries_ = 0;
    if (bodies_.fixedCount() == 0) return;
    const std::size_t ends = std::size_t(count_) + 1;
    fixedCounts_.reserve(ends);
    device_.fill(fixedCounts_, 0, ends);
    countMembers(device_.launch(), fixed(), fixedCounts_.data(), badRow_.data());
    device_.copy(offsets_, fixedCounts_, ends);
    sumCounts(device_.launch(), scratch_.data(), scratchBytes_, offsets_.data(), count_);
    std::uint32_t total = 0;
    device_.fetch(&total, entries(), sizeof total);
    requireCounted(total);
    fixedMembers_.reserve(total);
    fixedCells_.reserve(total);
    placeMembers(device_.launch(), fixed(),
                 {offsets_.data(), fixedMembers_.data(), fixedCells_.data(), count_, total});
    fixedEntries_ = total;
}

template <class Real>
void DeviceGrid<Real>::prepare(Real margin) {
    if (room_ == 0) {
        makeRoom(2 * (std::size_t(bodies_.movingCount()) + bodies_.fixedCount()) + 1024);
    }
    if (fixedListed_ && margin == margin_) return;
    margin_ = margin;
    fixedListed_ = false;
    listFixed();
    fixedListed_ = true;
}

template <class Real>
void DeviceGrid<Real>::sort(Real margin) {
    prepare(margin);
    const std::size_t ends = std::size_t(count_) + 1;
    if (fixedEntries_ > 0) {
        device_.copy(offsets_, fixedCounts_, ends);
    } else {
        device_.fill(offsets_, 0, ends);
    }
    device_.fill(badRow_, 0xff, 1);
    countMembers(device_.launch(), moving(), offsets_.data(), badRow_.data());
    sumCounts(device_.launch(), scratch_.data(), scratchBytes_, offsets_.data(), count_);
    place();
}

template <class Real>
void DeviceGrid<Real>::sortAgain(std::uint32_t entries) {
    requireCounted(entries);
    makeRoom(entries);
    place();
}

template <class Real>
void DeviceGrid<Real>::makeRoom(std::size_t entries) {
    room_ = 0;
    members_.reserve(entries);
    cellOfEntry_.reserve(entries);
    room_ = static_cast<std::uint32_t>(std::min<std::size_t>(entries, none - 1));
}

template <class Real>
void DeviceGrid<Real>::expect(std::uint32_t entries) {
    // Only where it differs much, so that most steps are launched as the one before.
    if (entries + entries / 32 <= room_ && room_ <= entries + entries / 8 + 512) return;
    const std::size_t guess = std::size_t(entries) + entries / 16 + 256;
    room_ = static_cast<std::uint32_t>(
        std::min({guess, members_.capacity(), cellOfEntry_.capacity(), std::size_t(none - 1)}));
}

template <class Real>
void DeviceGrid<Real>::place() {
    const GridEntries entries{offsets_.data(), members_.data(), cellOfEntry_.data(), count_, room_};
    placeListed(device_.launch(), {fixedMembers_.data(), fixedCells_.data(), fixedEntries_},
                entries);
    placeMembers(device_.launch(), moving(), entries);
}

template <class Real>
DeviceCells DeviceGrid<Real>::cells() const {
    return {.offsets = offsets_.data(),
            .bodies = members_.data(),
            .cellOfEntry = cellOfEntry_.data(),
            .cells = count_,
            .entries = room_};
}

template <class Real>
void DeviceGrid<Real>::fetch(Cells& cells) const {
    cells.origin = origin_;
    cells.fineCell = cellSize_;
    cells.offsets.resize(count_ + 1);
    device_.fetch(cells.offsets.data(), offsets_.data(),
                  cells.offsets.size() * sizeof(std::uint32_t));
    cells.coordinates.resize(count_);
    device_.fetch(cells.coordinates.data(), coordinates_.data(), count_ * sizeof(CellCoordinates));
    cells.bodies.resize(cells.offsets.back());
    device_.fetch(cells.bodies.data(), members_.data(), cells.bodies.size() * sizeof(BodyRef));
    for (std::size_t c = 0; c < count_; ++c) {
        std::sort(cells.bodies.begin() + cells.offsets[c],
                  cells.bodies.begin() + cells.offsets[c + 1]);
    }
}

template class DeviceGrid<double>;
template class DeviceGrid<float>;

}  // namespace quadrille::cuda
