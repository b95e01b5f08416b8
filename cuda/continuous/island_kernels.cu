#include "collision/make_record.hpp"
#include "collision/rules/event_rules.hpp"
#include "collision/rules/next_event.hpp"
#include "cuda/continuous/island_kernels.hpp"
#include "cuda/continuous/window_threads.cuh"

namespace quadrille::cuda {

namespace {

// ---- islands: a forest that threads join as they meet (Jaiganesh & Burtscher 2018)

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
            // Agreed on before the leader changes what the others look at.
            if (!warp_.all(isCurrent(event))) continue;
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
        if (event.withStatic()) {
            held_ = event.time == heldAt_ ? held_ + 1 : 1;
            heldAt_ = event.time;
            if (held_ > mostHeld) fail(trouble::crowded);
        }
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
    std::uint32_t held_ = 0;  // events with static bodies at one instant, of all bodies together
    double heldAt_ = -1;      // s
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

}  // namespace

template <class Real>
void runIslands(const Launch& launch, const EventBodies<Real>& bodies, const Window& window,
                const WindowExpectation& expected) {
    const int size = launch.options.blockSize;
    const unsigned forWarps = blocksToFill(launch, expected.concerned, warpsOfBlock, warpsBlock);
    floodKernel<<<forWarps, warpsBlock, 0, launch.stream>>>(bodies, window);
    checkLaunch("floodKernel");
    groupKernel<<<blocksToFill(launch, std::max(expected.claimed, expected.events)), size, 0,
                  launch.stream>>>(bodies, window);
    checkLaunch("groupKernel");
    islandsKernel<<<forWarps, warpsBlock, 0, launch.stream>>>(bodies, window);
    checkLaunch("islandsKernel");
}

#define QUADRILLE_INSTANTIATE(Real)                                                  \
    template void runIslands(const Launch&, const EventBodies<Real>&, const Window&, \
                             const WindowExpectation&);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille::cuda
