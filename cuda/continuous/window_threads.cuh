#pragma once

#include <cooperative_groups.h>
#include <cstdint>

#include "cuda/continuous/device_window.hpp"
#include "cuda/device/launch.cuh"

/// What the kernels of a window have in common.

namespace quadrille::cuda {

namespace groups = cooperative_groups;

/// Threads that look at the neighbours of a body together.
constexpr int tileSize = 8;
using Tile = groups::thread_block_tile<tileSize>;
using Warp = groups::thread_block_tile<32>;

/// Blocks of a fixed size, for kernels that share memory or need many registers.
constexpr int tilesBlock = 256;
constexpr int tilesOfBlock = tilesBlock / tileSize;
constexpr int eventsBlock = 64;
constexpr int warpsBlock = 128;
constexpr int warpsOfBlock = warpsBlock / 32;

__device__ inline void report(WindowCounts* counts, std::uint32_t bit) {
    atomicOr(&counts->troubles.value, bit);
}
__device__ inline bool troubled(const WindowCounts* counts) {
    return *static_cast<const volatile std::uint32_t*>(&counts->troubles.value) != 0;
}

/// The neighbour that the thread of a tile looks at, of those from `start` on.
struct Neighbour {
    BodyRef body;
    std::uint32_t row;  ///< of a static one, the body itself, which is as near
    bool there;
};

/// Calls `look(neighbour)` for all neighbours of a body, by all threads of a tile together.
template <class Real, class Threads, class Look>
__device__ void forNeighbours(const EventBodies<Real>& bodies, const Threads& tile,
                              std::uint32_t row, const Look& look) {
    const std::uint32_t first = bodies.starts[row];
    const std::uint32_t last = bodies.starts[row + 1];
    for (std::uint32_t start = first; start < last; start += tile.size()) {
        const std::uint32_t place = start + tile.thread_rank();
        const bool there = place < last;
        const BodyRef body = bodies.others[there ? place : start];
        look(Neighbour{body, body.isStatic() ? row : body.row(), there});
    }
}

template <class Real>
__device__ bool near(const EventBodies<Real>& bodies, const PathSketch& own, std::uint32_t row,
                     const Neighbour& other, const SketchSpan& span) {
    return isNear(own, bodies.sketches[other.row], sketchSize(bodies.motion, row),
                  sketchSize(bodies.motion, other.row), span);
}

/// A body's path is another one for those that come after.
template <class Real>
__device__ void noteChange(const EventBodies<Real>& bodies, const Window& window,
                           std::uint32_t row) {
    bodies.changedIn[row] = window.number;
    bodies.sketches[row] = sketchOf(bodies.motion, row, bodies.lists.from);
}

template <class Real>
__device__ void keep(const EventBodies<Real>& bodies, const RecordedContact& recorded) {
    const std::uint32_t place = countUp(&bodies.counts->records.value);
    if (place < bodies.recordRoom) {
        bodies.records[place] = recorded;
    } else {
        report(bodies.counts, trouble::records);
    }
}

/// Towards the root of a body's island; `none` if it is in none.
__device__ inline std::uint32_t parentOf(const std::uint32_t* parents, std::uint32_t row) {
    return *static_cast<const volatile std::uint32_t*>(parents + row);
}

}  // namespace quadrille::cuda
