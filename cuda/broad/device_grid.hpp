#pragma once

#include <cstddef>
#include <cstdint>

#include <quadrille/cells.hpp>
#include <quadrille/partitioner_config.hpp>
#include <quadrille/vec2.hpp>

#include "collision/rules/fine_grid.hpp"
#include "cuda/bodies/device_bodies.hpp"
#include "cuda/broad/grid_kernels.hpp"
#include "cuda/device/device_session.hpp"
#include "cuda/device/memory.hpp"
#include "cuda/pairs/pair_kernels.hpp"

namespace quadrille::cuda {

/// The cells of StaticGrid, made on the device. In a cell, moving bodies stand in any order.
template <class Real>
class DeviceGrid {
  public:
    /// Both must outlive this.
    DeviceGrid(DeviceSession& device, const DeviceBodies<Real>& bodies)
        : device_(device), bodies_(bodies) {}

    /// Lays cells over the world, for bodies of which the static ones may be others than before.
    /// Throws Error if the cell size is impossible.
    void lay(const StaticGrid& config, const Vec2& worldSize);

    /// Does what a sort with such a margin needs once, so that it neither allocates nor waits:
    /// makes room, and lists the cells of the static bodies. Throws Error if 32 bits cannot count
    /// them.
    void prepare(Real margin = 0);
    /// Sorts the bodies into the cells, anew; into all that they touch as long as they get on by no
    /// more than a margin, px.
    void sort(Real margin = 0);
    /// After a step has told how many entries there were (`entries`, where the device counts them).
    bool lacksRoom(std::uint32_t entries) const { return entries > room_; }
    /// Makes room for so many, and puts the bodies into the cells. Throws Error if 32 bits cannot
    /// count them.
    void sortAgain(std::uint32_t entries);
    /// Makes room for so many, for the next sort.
    void makeRoom(std::size_t entries);
    /// What the step has told is the guess for the next one.
    void expect(std::uint32_t entries);

    /// Entries that a try is launched for.
    std::uint32_t room() const { return room_; }

    DeviceCells cells() const;
    CellOwnership<Real> ownership() const { return {coordinates_.data(), grid_, margin_}; }
    const std::uint32_t* entries() const { return offsets_.data() + count_; }
    /// The lowest moving row whose position was not finite when it was sorted, else `none`.
    const std::uint32_t* badRow() const { return badRow_.data(); }

    /// Brings the cells of the last sort, as the partitioner StaticGrid has them.
    void fetch(Cells& cells) const;

  private:
    GridInput<Real> moving() const;
    GridInput<Real> fixed() const;
    void listFixed();
    void place();

    DeviceSession& device_;
    const DeviceBodies<Real>& bodies_;
    FineGrid<Real> grid_;
    Real margin_ = 0;
    Vec2 origin_{0, 0}, cellSize_{0, 0};
    std::uint32_t columns_ = 0, count_ = 0;
    DeviceArray<CellCoordinates> coordinates_{device_.budget()};
    DeviceArray<std::uint32_t> offsets_{device_.budget()};  // of each cell, and the end
    DeviceArray<BodyRef> members_{device_.budget()};
    DeviceArray<std::uint32_t> cellOfEntry_{device_.budget()};
    // The static bodies, of which a margin has been listed: their number in each cell, and entries.
    DeviceArray<std::uint32_t> fixedCounts_{device_.budget()};
    DeviceArray<BodyRef> fixedMembers_{device_.budget()};
    DeviceArray<std::uint32_t> fixedCells_{device_.budget()};
    std::uint32_t fixedEntries_ = 0;
    bool fixedListed_ = false;
    DeviceArray<std::byte> scratch_{device_.budget()};
    std::size_t scratchBytes_ = 0;
    DeviceArray<std::uint32_t> badRow_{device_.budget()};
    std::uint32_t room_ = 0;  // for entries in a try, up to what is allocated
};

}  // namespace quadrille::cuda
