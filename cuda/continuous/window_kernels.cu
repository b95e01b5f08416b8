#include "collision/rules/next_event.hpp"
#include "cuda/continuous/event_kernels.hpp"
#include "cuda/continuous/island_kernels.hpp"
#include "cuda/continuous/window_kernels.hpp"
#include "cuda/continuous/window_lists.cuh"
#include "cuda/continuous/window_threads.cuh"
#include "cuda/device/warp_tasks.cuh"

namespace quadrille::cuda {

namespace {

/// A body that may have changed: those of the islands, then both of each event.
struct Changed {
    std::uint32_t row;  ///< `none` if it has not
    std::size_t slot;   ///< of what it was before
    bool ofIsland;
};

/// A body that has changed and another that it may meet.
struct NearPair {
    std::uint32_t row;
    std::uint32_t other;  ///< BodyRef::bits; shared memory has nothing with initial values
};

template <class Real>
__device__ Changed changedAt(const EventBodies<Real>& bodies, const Window& window, std::uint32_t i,
                             std::uint32_t claimed, bool troubles) {
    if (i < claimed) {
        const std::uint32_t row = bodies.claimed[i];
        return {bodies.changedIn[row] == window.number ? row : none, i, true};
    }
    const std::uint32_t side = i - claimed;
    const std::uint32_t event = side / 2;
    const Fate fate = bodies.fates[event];
    const BodyRef body =
        side % 2 == 0 ? BodyRef::moving(bodies.events[event].a) : bodies.events[event].b;
    // The island has what became of it, unless it came to nothing.
    const bool alone = troubles || parentOf(bodies.parents, bodies.events[event].a) == none;
    const bool changes = fate == Fate::Collision && alone && !body.isStatic();
    return {changes ? body.row() : none, side, false};
}

/// Lists what the bodies that have changed do in later windows, or takes the changes back.
template <class Real>
__global__ void __launch_bounds__(tilesBlock, 4)
    finishKernel(EventBodies<Real> bodies, Window window) {
    __shared__ NearPair nearPairs[tilesBlock / 32][WarpTasks<NearPair>::room];
    WarpTasks<NearPair> waiting(nearPairs[threadIdx.x / 32]);
    const auto find = [&](const NearPair& pair) {
        const BodyRef one[1] = {{pair.other}};
        findFor(bodies.motion, pair.row, one, window.to, bodies.horizon,
                [&](const PairEvent& event) {
                    if (event.time > window.to) listMeeting(bodies.lists, event);
                });
    };
    const std::uint32_t troubles = bodies.counts->troubles.value;
    const std::uint32_t claimed = min(bodies.counts->claimed.value, bodies.claimedRoom);
    // Where there was no room for events, none was carried out.
    constexpr std::uint32_t early =
        trouble::partition | trouble::entries | trouble::events | trouble::notFinite;
    const std::uint32_t events = (troubles & early) != 0 ? 0 : bodies.counts->events.value;
    const SketchSpan span = sketchSpan(bodies.lists.from, window.to, bodies.horizon, bodies.slack);
    const std::uint32_t all = claimed + 2 * events;
    // A tile for each body; the warp stays together.
    constexpr std::uint32_t together = 32 / tileSize;
    const std::uint32_t rank = threadIdx.x % tileSize;
    for (std::uint32_t first = threadNumber() / 32 * together; first < all;
         first += threadCount() / 32 * together) {
        const std::uint32_t i = first + threadIdx.x % 32 / tileSize;
        Changed changed{none, 0, false};
        if (i < all) changed = changedAt(bodies, window, i, claimed, troubles != 0);
        const std::uint32_t row = changed.row;
        if (troubles != 0) {
            if (row != none && rank == 0) {
                bodies.motion.takeBack(
                    row, (changed.ofIsland ? bodies.before : bodies.anchorsOf)[changed.slot]);
                bodies.sketches[row] = sketchOf(bodies.motion, row, bodies.lists.from);
            }
            continue;
        }
        const std::uint32_t self = row == none ? 0 : row;
        const PathSketch own = bodies.sketches[self];
        const std::uint32_t last = row == none ? 0 : bodies.starts[row + 1];
        std::uint32_t place = row == none ? 0 : bodies.starts[row] + rank;
        for (; __any_sync(0xffff'ffffu, place < last); place += tileSize) {
            const bool there = place < last;
            const BodyRef body = there ? bodies.others[place] : BodyRef::fixed(0);
            const Neighbour other{body, body.isStatic() ? self : body.row(), there};
            // Of two bodies that both have changed, the first one's threads do it.
            const bool theirs = (bodies.changedIn[other.row] == window.number) & (other.row < row);
            const bool comes = near(bodies, own, self, other, span);
            waiting.add(there & !theirs & comes, {row, body.bits}, find);
        }
    }
    waiting.flush(find);
}

/// There are no islands any more; the host is told what the window was.
template <class Real>
__global__ void __launch_bounds__(largestBlock)
    reportKernel(EventBodies<Real> bodies, Window window, WindowResult* result) {
    const std::uint32_t claimed = min(bodies.counts->claimed.value, bodies.claimedRoom);
    for (std::uint32_t i = threadNumber(); i < claimed; i += threadCount()) {
        const std::uint32_t row = bodies.claimed[i];
        bodies.parents[row] = none;
        bodies.firstEvent[row] = none;
    }
    if (threadNumber() == 0) {
        *result = {.troubles = bodies.counts->troubles.value,
                   .entries = bodies.lists[window.list].count->value,
                   .events = bodies.counts->events.value,
                   .concerned = bodies.counts->concerned.value,
                   .claimed = bodies.counts->claimed.value,
                   .records = bodies.counts->records.value,
                   .collisions = bodies.counts->collisions,
                   .gridEntries = *bodies.gridEntries,
                   .badRow = *bodies.badRow,
                   .pairs = bodies.found->candidates,
                   .survey = *bodies.survey};
        *bodies.nextCounts = {};
    }
}

}  // namespace

template <class Real>
void runWindow(const Launch& launch, const EventBodies<Real>& bodies, const Window& window,
               const WindowExpectation& expected, WindowResult* result) {
    const int size = launch.options.blockSize;
    runEvents(launch, bodies, window, expected);
    runIslands(launch, bodies, window, expected);
    finishKernel<<<blocksToFill(launch, expected.claimed + 2 * expected.events, tilesOfBlock,
                                tilesBlock),
                   tilesBlock, 0, launch.stream>>>(bodies, window);
    checkLaunch("finishKernel");
    reportKernel<<<blocksToFill(launch, expected.claimed), size, 0, launch.stream>>>(bodies, window,
                                                                                     result);
    checkLaunch("reportKernel");
}

#define QUADRILLE_INSTANTIATE(Real)                                                 \
    template void runWindow(const Launch&, const EventBodies<Real>&, const Window&, \
                            const WindowExpectation&, WindowResult*);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille::cuda
