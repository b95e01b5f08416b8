#pragma once

#include <cstddef>
#include <cstdint>

#include <quadrille/body_ref.hpp>
#include <quadrille/cell_coordinates.hpp>

#include "collision/rules/bodies.hpp"
#include "collision/rules/fine_grid.hpp"
#include "cuda/device/launch.hpp"

/// A grid's cells, made on the device by a counting sort. All pointers are to device memory.

namespace quadrille::cuda {

/// Bodies, and the grid that they are to be sorted into.
template <class Real>
struct GridInput {
    Bodies<Real> bodies;
    std::uint32_t moving, fixed;  ///< rows
    FineGrid<Real> grid;
    std::uint32_t columns;
    Real margin;  ///< px, added to half extents
};

/// The coordinates of each of the grid's cells.
void layCoordinates(const Launch& launch, CellCoordinates* coordinates, std::uint32_t columns,
                    std::uint32_t cells);

/// Adds one to the count of each cell for each body that touches it. `*badRow` becomes the lowest
/// moving row whose position is not finite, if it is below what it was.
template <class Real>
void countMembers(const Launch& launch, const GridInput<Real>& input, std::uint32_t* counts,
                  std::uint32_t* badRow);

/// Makes of `cells` counts, followed by a 0, where each cell ends and, last, how many entries there
/// are: 0xffffffff if 32 bits cannot count them. With no `scratch`, only says in `bytes` how much
/// of it is needed.
void sumCounts(const Launch& launch, void* scratch, std::size_t& bytes, std::uint32_t* counts,
               std::uint32_t cells);

/// Where the entries go to.
struct GridEntries {
    std::uint32_t* ends;  ///< of each cell, and then the number of entries; become their beginnings
    BodyRef* bodies;
    std::uint32_t* cellOfEntry;
    std::uint32_t cells, room;
};

/// Bodies and cells that they touch.
struct ListedEntries {
    const BodyRef* bodies;
    const std::uint32_t* cells;
    std::uint32_t count;
};

/// Writes what is listed to its cells, after all that is written later. Does nothing if there is no
/// room for all entries, listed or not.
void placeListed(const Launch& launch, const ListedEntries& listed, const GridEntries& entries);

/// Writes each body to each cell that it touches, the static ones last. Does nothing if there is no
/// room for all entries.
template <class Real>
void placeMembers(const Launch& launch, const GridInput<Real>& input, const GridEntries& entries);

}  // namespace quadrille::cuda
