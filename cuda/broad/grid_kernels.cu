#include <cub/device/device_scan.cuh>

#include "collision/rules/pair_geometry.hpp"
#include "cuda/broad/grid_kernels.hpp"
#include "cuda/device/launch.cuh"

namespace quadrille::cuda {

namespace {

/// A body that touches more cells than this is shared out among the threads of its block.
constexpr std::uint32_t mostForOneThread = 16;

__device__ inline std::uint32_t cellsIn(const FineRange& range) {
    return (range.x1 - range.x0 + 1u) * (range.y1 - range.y0 + 1u);
}

/// Calls `visit(cell, body)` for every `apart`th cell that the body touches, from the `first` on.
template <class Visit>
__device__ void forEachCell(const FineRange& range, std::uint32_t columns, BodyRef body,
                            std::uint32_t first, std::uint32_t apart, const Visit& visit) {
    const std::uint32_t width = range.x1 - range.x0 + 1u;
    for (std::uint32_t i = first; i < cellsIn(range); i += apart) {
        visit((range.y0 + i / width) * columns + range.x0 + i % width, body);
    }
}

/// Calls `visit(cell, body)` for each cell that each of the bodies from `row(0)` to before
/// `row(count)` touches. All threads of a block must come.
template <class Real, class Row, class Visit>
__device__ void visitCells(const GridInput<Real>& input, std::uint32_t count, const Row& row,
                           const Visit& visit) {
    __shared__ std::uint32_t wide[largestBlock];
    __shared__ std::uint32_t wides;
    if (threadIdx.x == 0) wides = 0;
    __syncthreads();
    const auto rangeOf = [&](BodyRef body) {
        const Box<Real> box = inflated(boxOf(input.bodies, body), input.margin);
        return input.grid.range(box.x, box.y, box.halfWidth, box.halfHeight);
    };
    const std::uint32_t i = threadNumber();
    if (i < count) {
        const BodyRef body = row(i);
        const FineRange range = rangeOf(body);
        if (cellsIn(range) <= mostForOneThread) {
            forEachCell(range, input.columns, body, 0, 1, visit);
        } else {
            wide[atomicAdd(&wides, 1u)] = i;
        }
    }
    __syncthreads();
    for (std::uint32_t w = 0; w < wides; ++w) {
        const BodyRef body = row(wide[w]);
        forEachCell(rangeOf(body), input.columns, body, threadIdx.x, blockDim.x, visit);
    }
}

template <class Real>
__global__ void __launch_bounds__(largestBlock)
    countMembersKernel(GridInput<Real> input, std::uint32_t* counts, std::uint32_t* badRow) {
    const std::uint32_t i = threadNumber();
    if (i < input.moving) {
        const auto& m = input.bodies.moving;
        if (!isfinite(m.x[i]) || !isfinite(m.y[i])) atomicMin(badRow, i);
    }
    visitCells(
        input, input.moving + input.fixed,
        [&](std::uint32_t place) {
            return place < input.moving ? BodyRef::moving(place)
                                        : BodyRef::fixed(place - input.moving);
        },
        [&](std::uint32_t cell, BodyRef) { atomicAdd(&counts[cell], 1u); });
}

/// What goes to a cell goes before what is there, so static bodies come first.
template <class Real, bool Static>
__global__ void __launch_bounds__(largestBlock)
    placeMembersKernel(GridInput<Real> input, GridEntries entries) {
    if (entries.ends[entries.cells] > entries.room) return;
    visitCells(
        input, Static ? input.fixed : input.moving,
        [](std::uint32_t row) { return Static ? BodyRef::fixed(row) : BodyRef::moving(row); },
        [&](std::uint32_t cell, BodyRef body) {
            const std::uint32_t place = atomicSub(&entries.ends[cell], 1u) - 1;
            entries.bodies[place] = body;
            entries.cellOfEntry[place] = cell;
        });
}

/// The same for entries whose cells are known.
__global__ void __launch_bounds__(largestBlock)
    placeListedKernel(ListedEntries listed, GridEntries entries) {
    const std::uint32_t i = threadNumber();
    if (i >= listed.count || entries.ends[entries.cells] > entries.room) return;
    const std::uint32_t cell = listed.cells[i];
    const std::uint32_t place = atomicSub(&entries.ends[cell], 1u) - 1;
    entries.bodies[place] = listed.bodies[i];
    entries.cellOfEntry[place] = cell;
}

__global__ void __launch_bounds__(largestBlock)
    layCoordinatesKernel(CellCoordinates* coordinates, std::uint32_t columns, std::uint32_t cells) {
    const std::uint32_t cell = threadNumber();
    if (cell >= cells) return;
    coordinates[cell] = {static_cast<std::uint16_t>(cell % columns),
                         static_cast<std::uint16_t>(cell / columns), 0};
}

/// A sum that stays at the largest number instead of wrapping.
struct SaturatingSum {
    __host__ __device__ std::uint32_t operator()(std::uint32_t a, std::uint32_t b) const {
        return a + b < a ? 0xffff'ffffu : a + b;
    }
};

}  // namespace

void layCoordinates(const Launch& launch, CellCoordinates* coordinates, std::uint32_t columns,
                    std::uint32_t cells) {
    const int size = launch.options.blockSize;
    layCoordinatesKernel<<<blocksFor(cells, size), size, 0, launch.stream>>>(coordinates, columns,
                                                                             cells);
    checkLaunch("layCoordinatesKernel");
}

template <class Real>
void countMembers(const Launch& launch, const GridInput<Real>& input, std::uint32_t* counts,
                  std::uint32_t* badRow) {
    const int size = launch.options.blockSize;
    countMembersKernel<<<blocksFor(input.moving + input.fixed, size), size, 0, launch.stream>>>(
        input, counts, badRow);
    checkLaunch("countMembersKernel");
}

void sumCounts(const Launch& launch, void* scratch, std::size_t& bytes, std::uint32_t* counts,
               std::uint32_t cells) {
    check(cub::DeviceScan::InclusiveScan(scratch, bytes, counts, counts, SaturatingSum{}, cells + 1,
                                         launch.stream),
          "sumCounts");
}

template <class Real>
void placeMembers(const Launch& launch, const GridInput<Real>& input, const GridEntries& entries) {
    const int size = launch.options.blockSize;
    if (input.fixed > 0) {
        placeMembersKernel<Real, true>
            <<<blocksFor(input.fixed, size), size, 0, launch.stream>>>(input, entries);
    }
    if (input.moving > 0) {
        placeMembersKernel<Real, false>
            <<<blocksFor(input.moving, size), size, 0, launch.stream>>>(input, entries);
    }
    checkLaunch("placeMembersKernel");
}

void placeListed(const Launch& launch, const ListedEntries& listed, const GridEntries& entries) {
    if (listed.count == 0) return;
    const int size = launch.options.blockSize;
    placeListedKernel<<<blocksFor(listed.count, size), size, 0, launch.stream>>>(listed, entries);
    checkLaunch("placeListedKernel");
}

#define QUADRILLE_INSTANTIATE(Real)                                                   \
    template void countMembers(const Launch&, const GridInput<Real>&, std::uint32_t*, \
                               std::uint32_t*);                                       \
    template void placeMembers(const Launch&, const GridInput<Real>&, const GridEntries&);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille::cuda
