#include "collision/make_record.hpp"
#include "collision/rules/event_rules.hpp"
#include "collision/rules/next_event.hpp"
#include "cuda/continuous/event_kernels.hpp"
#include "cuda/continuous/window_threads.cuh"

namespace quadrille::cuda {

namespace {

/// Marks a body of an event. Returns whether it is the same event once more: pairs are listed again
/// when one of them has changed, and may then stand twice in a list.
template <class Real>
__device__ bool markedAlready(const EventBodies<Real>& bodies, const Window& window,
                              std::uint32_t row, BodyRef other) {
    auto* const mark = reinterpret_cast<unsigned long long*>(bodies.marks + row);
    const unsigned long long now =
        static_cast<unsigned long long>(other.bits) << 32 | window.number;
    const unsigned long long before = atomicExch(mark, now);
    if (before == now) return true;
    if (static_cast<std::uint32_t>(before) == window.number) bodies.busyIn[row] = window.number;
    return false;
}

/// Which of the listed pairs meet in the window, and marks their bodies; unless the partition is
/// not what it should be.
template <class Real>
__global__ void __launch_bounds__(largestBlock)
    gatherKernel(EventBodies<Real> bodies, Window window) {
    const WindowList list = bodies.lists[window.list];
    const std::uint32_t count = list.count->value;
    std::uint32_t troubles = 0;
    if (*bodies.badRow != none) troubles |= trouble::notFinite;
    if (bodies.found->candidates > bodies.pairRoom || *bodies.gridEntries > bodies.gridRoom) {
        troubles |= trouble::partition;
    }
    if (!(__longlong_as_double(static_cast<long long>(bodies.survey->fastest)) <= bodies.bound)) {
        troubles |= trouble::tooFast;
    }
    if (count > bodies.lists.room) troubles |= trouble::entries;
    if (troubles != 0) {
        if (threadNumber() == 0) report(bodies.counts, troubles);
        return;
    }
    for (std::uint32_t i = threadNumber(); i < count; i += threadCount()) {
        const CandidatePair pair = list.pairs[i];
        PairEvent event;
        bool happens = false;
        findNext(bodies.motion, pair.a, bodies.motion.paths(pair.a), pair.b,
                 bodies.motion.paths(pair.b), window.from, window.to, false,
                 [&](const PairEvent& found) {
                     event = found;
                     happens = found.time > window.from || window.first;
                 });
        if (!happens || markedAlready(bodies, window, event.a, event.b)) continue;
        const bool withStatic = event.withStatic();
        if (!withStatic) {
            markedAlready(bodies, window, event.b.row(), BodyRef::moving(event.a));
        }
        event.stampA = bodies.stamps[event.a];
        if (!withStatic) event.stampB = bodies.stamps[event.b.row()];
        const std::uint32_t place = countUp(&bodies.counts->events.value);
        if (place >= bodies.eventRoom) {
            report(bodies.counts, trouble::events);
            continue;
        }
        bodies.events[place] = event;
        bodies.eventOf[event.a] = place;
        if (!withStatic) bodies.eventOf[event.b.row()] = place;
    }
}

/// Carries out an event as if it concerned nobody else.
template <class Real>
__device__ Fate tryAlone(const EventBodies<Real>& bodies, const Window& window, std::uint32_t i) {
    const PairEvent event = bodies.events[i];
    const auto& anchors = bodies.motion.bodies.moving.anchors;
    const bool busy = bodies.busyIn[event.a] == window.number ||
                      (!event.withStatic() && bodies.busyIn[event.b.row()] == window.number);
    if (busy) return Fate::Concerned;
    bodies.anchorsOf[2 * std::size_t(i)] = anchors[event.a];
    if (!event.withStatic()) bodies.anchorsOf[2 * std::size_t(i) + 1] = anchors[event.b.row()];
    const EventContact contact = contactOf(bodies.motion, event);
    const EventOutcomes done =
        collide(bodies.motion, event, contact, [](int, double) { return 0.0; });
    if (!done.changes()) return Fate::Nothing;
    if (bodies.records != nullptr) bodies.recordOf[i] = makeRecord(event, contact, done);
    return Fate::Collision;
}

/// Whether a body of an event that was carried out is near one that has another event, or meets
/// anybody in this window. All threads of the tile come.
template <class Real>
__device__ bool concerns(const EventBodies<Real>& bodies, const Window& window, const Tile& tile,
                         const PairEvent& event, std::uint32_t row, std::uint32_t partner) {
    const auto& motion = bodies.motion;
    const PathSketch before = bodies.sketches[row];
    const PathSketch after = sketchOf(motion, row, bodies.lists.from);
    const SketchSpan close =
        sketchSpan(bodies.lists.from, window.from, window.from, bodies.slack + window.close);
    const SketchSpan rest = sketchSpan(bodies.lists.from, event.time, window.to, bodies.slack);
    bool meets = outruns(motion, row, event.time, bodies.horizon, SpeedBounds{bodies.bound});
    forNeighbours(bodies, tile, row, [&](const Neighbour& other) {
        if (!other.there) return;
        const bool marked = !other.body.isStatic() && other.row != partner &&
                            bodies.marks[other.row].window == window.number;
        if (marked) {
            meets = meets || near(bodies, before, row, other, close);
        } else if (other.body.isStatic() || near(bodies, after, row, other, rest)) {
            const BodyRef one[1] = {other.body};
            findFor(motion, row, one, event.time, window.to,
                    [&](const PairEvent& found) { meets = meets || found.time <= window.to; });
        }
    });
    return tile.any(meets);
}

/// Carries out each event as if it concerned nobody but its bodies.
template <class Real>
__global__ void __launch_bounds__(eventsBlock) tryKernel(EventBodies<Real> bodies, Window window) {
    if (troubled(bodies.counts)) return;
    const std::uint32_t count = bodies.counts->events.value;
    for (std::uint32_t i = threadNumber(); i < count; i += threadCount()) {
        bodies.fates[i] = tryAlone(bodies, window, i);
    }
}

/// Finds the events that do concern others, and takes them back: those with another event near
/// their bodies, or whose new paths meet anybody in this window. Sketches stay as they were, so
/// that all see who was near; paths of bodies with events are nobody else's to look at.
template <class Real>
__global__ void __launch_bounds__(tilesBlock, 4)
    concernKernel(EventBodies<Real> bodies, Window window) {
    if (troubled(bodies.counts)) return;
    const auto tile = groups::tiled_partition<tileSize>(groups::this_thread_block());
    const std::uint32_t count = bodies.counts->events.value;
    for (std::uint32_t i = threadNumber() / tileSize; i < count; i += threadCount() / tileSize) {
        const Fate fate = bodies.fates[i];
        if (fate == Fate::Nothing) continue;
        bool concerned = fate == Fate::Concerned;
        const PairEvent event = bodies.events[i];
        const std::uint32_t b = event.withStatic() ? none : event.b.row();
        if (!concerned) {
#pragma unroll 1  // twice the code would take more registers
            for (int side = 0; side < 2 && !concerned; ++side) {
                const std::uint32_t row = side == 0 ? event.a : b;
                if (row == none) break;
                concerned = concerns(bodies, window, tile, event, row, side == 0 ? b : event.a);
            }
            if (concerned && tile.thread_rank() == 0) {
                bodies.motion.takeBack(event.a, bodies.anchorsOf[2 * std::size_t(i)]);
                if (b != none) bodies.motion.takeBack(b, bodies.anchorsOf[2 * std::size_t(i) + 1]);
            }
        }
        if (!concerned || tile.thread_rank() != 0) continue;
        bodies.fates[i] = Fate::Concerned;
        bodies.concerned[countUp(&bodies.counts->concerned.value)] = i;
    }
}

}  // namespace

template <class Real>
void runEvents(const Launch& launch, const EventBodies<Real>& bodies, const Window& window,
               const WindowExpectation& expected) {
    const int size = launch.options.blockSize;
    gatherKernel<<<blocksToFill(launch, expected.entries), size, 0, launch.stream>>>(bodies,
                                                                                     window);
    checkLaunch("gatherKernel");
    tryKernel<<<blocksToFill(launch, expected.events, eventsBlock, eventsBlock), eventsBlock, 0,
                launch.stream>>>(bodies, window);
    checkLaunch("tryKernel");
    concernKernel<<<blocksToFill(launch, expected.events, tilesOfBlock, tilesBlock), tilesBlock, 0,
                    launch.stream>>>(bodies, window);
    checkLaunch("concernKernel");
}

#define QUADRILLE_INSTANTIATE(Real)                                                 \
    template void runEvents(const Launch&, const EventBodies<Real>&, const Window&, \
                            const WindowExpectation&);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille::cuda
