#include "cuda/broad/device_grid.hpp"

#include <algorithm>

#include <quadrille/error.hpp>

#include "collision/broad/body_ranges.hpp"
#include "collision/broad/static_grid.hpp"

namespace quadrille::cuda {

template <class Real>
void DeviceGrid<Real>::lay(const StaticGrid& config, const Vec2& worldSize) {
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
GridInput<Real> DeviceGrid<Real>::input() const {
    return {bodies_.bodies(), bodies_.movingCount(), bodies_.fixedCount(), grid_, columns_,
            margin_};
}

template <class Real>
void DeviceGrid<Real>::sort(Real margin) {
    margin_ = margin;
    if (room_ == 0)
        makeRoom(2 * (std::size_t(bodies_.movingCount()) + bodies_.fixedCount()) + 1024);
    device_.fill(offsets_, 0, count_ + 1);
    device_.fill(badRow_, 0xff, 1);
    countMembers(device_.launch(), input(), offsets_.data(), badRow_.data());
    sumCounts(device_.launch(), scratch_.data(), scratchBytes_, offsets_.data(), count_);
    place();
}

template <class Real>
void DeviceGrid<Real>::sortAgain(std::uint32_t entries) {
    if (entries == none) {
        throw Error("static grid: the entries do not fit 32 bits; use larger cells");
    }
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
    const std::size_t guess = std::size_t(entries) + entries / 16 + 256;
    room_ = static_cast<std::uint32_t>(
        std::min({guess, members_.capacity(), cellOfEntry_.capacity(), std::size_t(none - 1)}));
}

template <class Real>
void DeviceGrid<Real>::place() {
    placeMembers(device_.launch(), input(),
                 {offsets_.data(), members_.data(), cellOfEntry_.data(), count_, room_});
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
