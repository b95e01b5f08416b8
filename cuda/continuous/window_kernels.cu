#include <cooperative_groups.h>

#include "collision/make_record.hpp"
#include "collision/rules/event_rules.hpp"
#include "collision/rules/next_event.hpp"
#include "cuda/continuous/window_kernels.hpp"
#include "cuda/continuous/window_lists.cuh"
#include "cuda/device/launch.cuh"
#include "cuda/device/warp_tasks.cuh"

namespace quadrille::cuda {

namespace {

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

// ---- the events of the window

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

// ---- islands: a forest that threads join as they meet (Jaiganesh & Burtscher 2018)

__device__ inline std::uint32_t parentOf(const std::uint32_t* parents, std::uint32_t row) {
    return *static_cast<const volatile std::uint32_t*>(parents + row);
}

__device__ inline std::uint32_t rootOf(std::uint32_t* parents, std::uint32_t row) {
    for (;;) {
        const std::uint32_t parent = parentOf(parents, row);
        const std::uint32_t next = parentOf(parents, parent);
        if (parent == next) return parent;
        atomicCAS(&parents[row], parent, next);
        row = next;
    }
}

__device__ inline void unite(std::uint32_t* parents, std::uint32_t a, std::uint32_t b) {
    for (;;) {
        const std::uint32_t p = rootOf(parents, a);
        const std::uint32_t q = rootOf(parents, b);
        if (p == q) return;
        const std::uint32_t high = max(p, q);
        if (atomicCAS(&parents[high], high, min(p, q)) == high) return;
    }
}

/// Claims the bodies of an event and all those that may concern them, one warp each whatever it
/// claims first.
template <class Real>
class Flood {
  public:
    static constexpr std::uint32_t room = 96;

    __device__ Flood(const EventBodies<Real>& bodies, const Window& window, const Warp& warp,
                     std::uint32_t* rows)
        : bodies_(bodies), window_(window), warp_(warp), rows_(rows) {}

    __device__ void from(const PairEvent& event) {
        const bool two = !event.withStatic();
        const std::uint32_t row = warp_.thread_rank() == 0 ? event.a
                                  : two                    ? event.b.row()
                                                           : event.a;
        claim(warp_.thread_rank() < (two ? 2u : 1u), row);
        if (two && warp_.thread_rank() == 0) unite(bodies_.parents, event.a, event.b.row());
        while (waiting_ > 0) {
            const std::uint32_t next = rows_[--waiting_];
            warp_.sync();
            spread(next);
        }
    }

  private:
    /// All threads come, those with a row that `wants` it claim it.
    __device__ void claim(bool wants, std::uint32_t row) {
        const bool gets = wants && parentOf(bodies_.parents, row) == none &&
                          atomicCAS(&bodies_.parents[row], none, row) == none;
        const unsigned all = warp_.ballot(gets);
        if (all == 0) return;
        const auto count = static_cast<std::uint32_t>(__popc(all));
        std::uint32_t first = 0;
        if (warp_.thread_rank() == 0) first = atomicAdd(&bodies_.counts->claimed.value, count);
        first = warp_.shfl(first, 0);
        const std::uint32_t before = __popc(all & ((1u << warp_.thread_rank()) - 1));
        if (gets && first + before < bodies_.claimedRoom) bodies_.claimed[first + before] = row;
        if (gets && waiting_ + before < room) rows_[waiting_ + before] = row;
        if (warp_.thread_rank() == 0) {
            if (first + count > bodies_.claimedRoom) report(bodies_.counts, trouble::claimed);
            if (waiting_ + count > room) report(bodies_.counts, trouble::crowded);
        }
        waiting_ = min(waiting_ + count, room);
        warp_.sync();
    }
    __device__ void spread(std::uint32_t row) {
        const PathSketch own = bodies_.sketches[row];
        const SketchSpan close = sketchSpan(bodies_.lists.from, window_.from, window_.from,
                                            bodies_.slack + window_.close);
        forNeighbours(bodies_, warp_, row, [&](const Neighbour& other) {
            const bool wants =
                other.there && !other.body.isStatic() && near(bodies_, own, row, other, close);
            claim(wants, other.row);
            // Whoever claimed the other one sees this pair, too.
            if (wants && row < other.row) unite(bodies_.parents, row, other.row);
        });
    }

    const EventBodies<Real>& bodies_;
    const Window& window_;
    const Warp& warp_;
    std::uint32_t* const rows_;
    std::uint32_t waiting_ = 0;  // the same in all threads
};

template <class Real>
__global__ void __launch_bounds__(warpsBlock) floodKernel(EventBodies<Real> bodies, Window window) {
    if (__any_sync(0xffff'ffffu, troubled(bodies.counts))) return;
    __shared__ std::uint32_t rows[warpsOfBlock][Flood<Real>::room];
    const auto warp = groups::tiled_partition<32>(groups::this_thread_block());
    const std::uint32_t own = threadIdx.x / 32;
    const std::uint32_t count = bodies.counts->concerned.value;
    for (std::uint32_t i = blockIdx.x * warpsOfBlock + own; i < count;
         i += gridDim.x * warpsOfBlock) {
        Flood<Real>(bodies, window, warp, rows[own]).from(bodies.events[bodies.concerned[i]]);
    }
}

/// Gives each island its events, with the bodies as they were, and keeps what they were. Events of
/// no island are done.
template <class Real>
__global__ void __launch_bounds__(largestBlock)
    groupKernel(EventBodies<Real> bodies, Window window) {
    if (__syncthreads_or(troubled(bodies.counts))) return;
    const std::uint32_t claimed = bodies.counts->claimed.value;
    for (std::uint32_t i = threadNumber(); i < claimed; i += threadCount()) {
        const std::uint32_t row = bodies.claimed[i];
        if (bodies.marks[row].window == window.number && bodies.busyIn[row] != window.number) {
            // What it has done alone, it does again in the island.
            const std::uint32_t event = bodies.eventOf[row];
            const Fate fate = bodies.fates[event];
            if (fate == Fate::Collision) {
                const bool second = bodies.events[event].a != row;
                bodies.motion.takeBack(row, bodies.anchorsOf[2 * std::size_t(event) + second]);
            }
        }
        bodies.before[i] = bodies.motion.bodies.moving.anchors[row];
        // From here on the root itself, for the islands.
        const std::uint32_t root = rootOf(bodies.parents, row);
        *static_cast<volatile std::uint32_t*>(bodies.parents + row) = root;
    }
    const std::uint32_t events = bodies.counts->events.value;
    unsigned long long collisions = 0;
    for (std::uint32_t i = threadNumber(); i < events; i += threadCount()) {
        const PairEvent event = bodies.events[i];
        if (parentOf(bodies.parents, event.a) != none) {
            const std::uint32_t root = rootOf(bodies.parents, event.a);
            const std::uint32_t next = atomicExch(&bodies.firstEvent[root], i);
            bodies.nextEvent[i] = next;
            if (next == none) bodies.roots[countUp(&bodies.counts->islands.value)] = root;
            continue;
        }
        if (bodies.fates[i] == Fate::Nothing) continue;
        noteChange(bodies, window, event.a);
        if (!event.withStatic()) noteChange(bodies, window, event.b.row());
        ++collisions;
        if (bodies.records != nullptr) keep(bodies, {event, 0, bodies.recordOf[i]});
    }
    __syncthreads();
    addFromBlock(&bodies.counts->collisions, collisions);
}

// ---- the events of one island

/// What a warp shares.
struct IslandQueue {
    static constexpr std::uint32_t room = 64;
    static constexpr int mostDeep = 16;

    PairEvent events[room];
    std::uint32_t size;
    struct {
        std::uint32_t a;
        BodyRef b;
    } separated[mostDeep];  ///< pairs deep inside each other that collided at the present instant
};

/// Carries out the events of an island in the order of time, as EventLoop does for all bodies. All
/// threads of a warp go through it together: one carries out, all look for what comes next.
template <class Real>
class Island {
  public:
    __device__ Island(const EventBodies<Real>& bodies, const Window& window, const Warp& warp,
                      std::uint32_t root, IslandQueue& queue)
        : bodies_(bodies),
          motion_(bodies.motion),
          window_(window),
          warp_(warp),
          isLater_(eventOrder(bodies.motion.bodies)),
          root_(root),
          queue_(queue) {}

    __device__ void run() {
        if (leads()) {
            queue_.size = 0;
            for (std::uint32_t i = bodies_.firstEvent[root_]; i != none; i = bodies_.nextEvent[i]) {
                push(bodies_.events[i]);
            }
        }
        warp_.sync();
        while (queue_.size > 0 && !failed_) {
            const PairEvent event = popFirst();
            if (!isCurrent(event)) continue;
            int state = 0;
            if (leads()) {
                if (++events_ > mostEvents) fail(trouble::crowded);
                const bool changes = resolve(event);
                state = changes | failed_ << 1;
            }
            warp_.sync();
            state = warp_.shfl(state, 0);
            failed_ = (state & 2) != 0;
            if ((state & 1) == 0) continue;
            follow(event.a, event.time);
            if (!event.withStatic()) follow(event.b.row(), event.time);
            warp_.sync();
            failed_ = failed_ || queue_.size > IslandQueue::room;
        }
    }

    std::uint32_t collisions = 0;  // of the thread that leads

  private:
    /// So few that no body can be jammed (collision/continuous/bursts.hpp): a window is longer than
    /// an eighth of the long cells of time, and a short one may lie in two windows.
    static constexpr std::uint32_t mostEvents = 64;
    static constexpr std::uint32_t mostOverlaps = 32;

    __device__ bool leads() const { return warp_.thread_rank() == 0; }

    __device__ void fail(std::uint32_t why) {
        report(bodies_.counts, why);
        failed_ = true;
    }

    __device__ void push(const PairEvent& event) {
        const std::uint32_t place = atomicAdd(&queue_.size, 1u);
        if (place < IslandQueue::room) {
            queue_.events[place] = event;
        } else {
            report(bodies_.counts, trouble::crowded);
        }
    }
    /// All threads get the first event.
    __device__ PairEvent popFirst() {
        const std::uint32_t size = min(queue_.size, IslandQueue::room);
        std::uint32_t first = warp_.thread_rank();
        if (first + 32 < size && isLater_(queue_.events[first], queue_.events[first + 32])) {
            first += 32;
        }
        bool mine = first < size;
        const double time = mine ? queue_.events[first].time : never;
        double earliest = time;
        for (int apart = 16; apart > 0; apart /= 2) {
            earliest = min(earliest, warp_.shfl_xor(earliest, apart));
        }
        unsigned all = warp_.ballot(mine && time == earliest);
        int winner = __ffs(static_cast<int>(all)) - 1;
        std::uint32_t place = warp_.shfl(first, winner);
        for (all &= all - 1; all != 0; all &= all - 1) {
            const std::uint32_t other = warp_.shfl(first, __ffs(static_cast<int>(all)) - 1);
            if (isLater_(queue_.events[place], queue_.events[other])) place = other;
        }
        const PairEvent event = queue_.events[place];
        warp_.sync();
        if (leads()) {
            queue_.events[place] = queue_.events[size - 1];
            queue_.size = size - 1;
        }
        warp_.sync();
        return event;
    }
    __device__ bool isCurrent(const PairEvent& event) const {
        return event.stampA == bodies_.stamps[event.a] &&
               (event.withStatic() || event.stampB == bodies_.stamps[event.b.row()]);
    }

    /// Whether the pair, deep inside each other, has collided already at this instant.
    __device__ bool separatedAlready(const PairEvent& event) {
        if (event.time != instant_) deep_ = 0;
        instant_ = event.time;
        for (int i = 0; i < deep_; ++i) {
            const auto& pair = queue_.separated[i];
            if (pair.a == event.a && pair.b == event.b) return true;
        }
        if (deep_ == IslandQueue::mostDeep) {
            fail(trouble::crowded);
            return true;
        }
        queue_.separated[deep_++] = {event.a, event.b};
        return false;
    }

    /// Returns whether any path changed.
    __device__ bool resolve(const PairEvent& event) {
        const EventContact contact = contactOf(motion_, event);
        if (contact.deep) {
            if (separatedAlready(event)) return false;
            if (++overlaps_ > mostOverlaps) fail(trouble::crowded);
        }
        // Nothing is pushed along where nothing is lost.
        const EventOutcomes done =
            collide(motion_, event, contact, [](int, double) { return 0.0; });
        if (!done.changes()) return false;
        changed(event.a);
        if (!event.withStatic()) changed(event.b.row());
        if (done.collided() != 0) {
            ++collisions;
            if (bodies_.records != nullptr) {
                if (kept_ == 0 || isLater_(event, after_)) after_ = event;
                keep(bodies_, {after_, kept_++, makeRecord(event, contact, done)});
            }
        }
        return true;
    }
    __device__ void changed(std::uint32_t row) {
        ++bodies_.stamps[row];
        noteChange(bodies_, window_, row);
        if (outruns(motion_, row, window_.from, bodies_.horizon, SpeedBounds{bodies_.bound})) {
            fail(trouble::tooFast);
        }
    }

    /// Finds what happens next to a body in this window, with static ones and those of its island.
    __device__ void follow(std::uint32_t row, double now) {
        const SketchSpan span = sketchSpan(bodies_.lists.from, now, window_.to, bodies_.slack);
        const PathSketch own = bodies_.sketches[row];
        forNeighbours(bodies_, warp_, row, [&](const Neighbour& other) {
            const bool ours = other.there & (bodies_.parents[other.row] == root_);
            if (!ours || !near(bodies_, own, row, other, span)) return;
            const BodyRef one[1] = {other.body};
            findFor(motion_, row, one, now, window_.to, [&](PairEvent event) {
                event.stampA = bodies_.stamps[event.a];
                if (!event.withStatic()) event.stampB = bodies_.stamps[event.b.row()];
                push(event);
            });
        });
    }

    const EventBodies<Real>& bodies_;
    const ExactMotion<Real, StraightPath>& motion_;
    const Window& window_;
    const Warp& warp_;
    const EventOrder isLater_;
    const std::uint32_t root_;
    IslandQueue& queue_;
    int deep_ = 0;
    double instant_ = -1;  // s
    PairEvent after_;      // that the last contact counts as
    std::uint32_t kept_ = 0;
    std::uint32_t events_ = 0, overlaps_ = 0;
    bool failed_ = false;
};

template <class Real>
__global__ void __launch_bounds__(warpsBlock)
    islandsKernel(EventBodies<Real> bodies, Window window) {
    if (__syncthreads_or(troubled(bodies.counts))) return;
    __shared__ IslandQueue queues[warpsOfBlock];
    const auto warp = groups::tiled_partition<32>(groups::this_thread_block());
    const std::uint32_t own = threadIdx.x / 32;
    const std::uint32_t islands = bodies.counts->islands.value;
    unsigned long long collisions = 0;
    for (std::uint32_t i = blockIdx.x * warpsOfBlock + own; i < islands;
         i += gridDim.x * warpsOfBlock) {
        Island<Real> island(bodies, window, warp, bodies.roots[i], queues[own]);
        island.run();
        collisions += island.collisions;
        warp.sync();
    }
    __syncthreads();
    addFromBlock(&bodies.counts->collisions, collisions);
}

// ---- afterwards

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
    gatherKernel<<<blocksToFill(launch, expected.entries), size, 0, launch.stream>>>(bodies,
                                                                                     window);
    checkLaunch("gatherKernel");
    tryKernel<<<blocksToFill(launch, expected.events, eventsBlock, eventsBlock), eventsBlock, 0,
                launch.stream>>>(bodies, window);
    checkLaunch("tryKernel");
    concernKernel<<<blocksToFill(launch, expected.events, tilesOfBlock, tilesBlock), tilesBlock, 0,
                    launch.stream>>>(bodies, window);
    checkLaunch("concernKernel");
    const unsigned forWarps = blocksToFill(launch, expected.concerned, warpsOfBlock, warpsBlock);
    floodKernel<<<forWarps, warpsBlock, 0, launch.stream>>>(bodies, window);
    checkLaunch("floodKernel");
    groupKernel<<<blocksToFill(launch, std::max(expected.claimed, expected.events)), size, 0,
                  launch.stream>>>(bodies, window);
    checkLaunch("groupKernel");
    islandsKernel<<<forWarps, warpsBlock, 0, launch.stream>>>(bodies, window);
    checkLaunch("islandsKernel");
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
