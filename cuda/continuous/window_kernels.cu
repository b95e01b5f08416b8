#include "collision/make_record.hpp"
#include "collision/rules/event_rules.hpp"
#include "collision/rules/next_event.hpp"
#include "cuda/continuous/window_kernels.hpp"
#include "cuda/continuous/window_lists.cuh"
#include "cuda/device/launch.cuh"

namespace quadrille::cuda {

namespace {

/// A thread for each island; more registers than larger blocks could have.
constexpr int islandBlock = 64;

__device__ inline void report(WindowCounts* counts, std::uint32_t bit) {
    atomicOr(&counts->troubles.value, bit);
}
__device__ inline bool troubled(const WindowCounts* counts) {
    return *static_cast<const volatile std::uint32_t*>(&counts->troubles.value) != 0;
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

/// Claims the bodies of an event and all those that may concern them, one thread each whatever it
/// claims first.
template <class Real>
class Flood {
  public:
    __device__ Flood(const EventBodies<Real>& bodies, const Window& window)
        : bodies_(bodies), window_(window) {}

    __device__ void from(const PairEvent& event) {
        claim(event.a);
        if (!event.withStatic()) {
            claim(event.b.row());
            unite(bodies_.parents, event.a, event.b.row());
        }
        while (waiting_ > 0) spread(rows_[--waiting_]);
    }

  private:
    static constexpr int room = 24;

    __device__ void claim(std::uint32_t row) {
        if (parentOf(bodies_.parents, row) != none) return;
        if (atomicCAS(&bodies_.parents[row], none, row) != none) return;
        const std::uint32_t place = countUp(&bodies_.counts->claimed.value);
        if (place < bodies_.claimedRoom) {
            bodies_.claimed[place] = row;
        } else {
            report(bodies_.counts, trouble::claimed);
        }
        if (waiting_ < room) {
            rows_[waiting_++] = row;
        } else {
            report(bodies_.counts, trouble::crowded);
        }
    }
    __device__ void spread(std::uint32_t row) {
        const SketchSpan span = sketchSpan(bodies_.lists.from, window_.from, window_.from,
                                           bodies_.slack + window_.close);
        forEachNear(
            bodies_, row, span, [](std::uint32_t) { return true; },
            [&](BodyRef other) {
                if (other.isStatic()) return;
                claim(other.row());
                // Whoever claimed the other one sees this pair, too.
                if (row < other.row()) unite(bodies_.parents, row, other.row());
            });
    }

    const EventBodies<Real>& bodies_;
    const Window& window_;
    std::uint32_t rows_[room];
    int waiting_ = 0;
};

/// The events of the window, and the islands around them.
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
        if (!happens) continue;
        event.stampA = bodies.stamps[event.a];
        if (!event.withStatic()) event.stampB = bodies.stamps[event.b.row()];
        const std::uint32_t place = countUp(&bodies.counts->events.value);
        if (place >= bodies.eventRoom) {
            report(bodies.counts, trouble::events);
            continue;
        }
        bodies.events[place] = event;
        Flood<Real>(bodies, window).from(event);
    }
}

/// Gives each island its events, and keeps what its bodies were.
template <class Real>
__global__ void __launch_bounds__(largestBlock) groupKernel(EventBodies<Real> bodies) {
    if (troubled(bodies.counts)) return;
    const std::uint32_t claimed = bodies.counts->claimed.value;
    for (std::uint32_t i = threadNumber(); i < claimed; i += threadCount()) {
        const std::uint32_t row = bodies.claimed[i];
        bodies.before[i] = bodies.motion.bodies.moving.anchors[row];
        // From here on the root itself, for the islands.
        const std::uint32_t root = rootOf(bodies.parents, row);
        *static_cast<volatile std::uint32_t*>(bodies.parents + row) = root;
    }
    const std::uint32_t events = bodies.counts->events.value;
    for (std::uint32_t i = threadNumber(); i < events; i += threadCount()) {
        const std::uint32_t root = rootOf(bodies.parents, bodies.events[i].a);
        const std::uint32_t next = atomicExch(&bodies.firstEvent[root], i);
        bodies.nextEvent[i] = next;
        if (next == none) bodies.roots[countUp(&bodies.counts->islands.value)] = root;
    }
}

// ---- the events of one island

/// Carries out the events of an island in the order of time, as EventLoop does for all bodies.
template <class Real>
class Island {
  public:
    __device__ Island(const EventBodies<Real>& bodies, const Window& window, std::uint32_t root)
        : bodies_(bodies),
          motion_(bodies.motion),
          window_(window),
          isLater_(eventOrder(bodies.motion.bodies)),
          root_(root) {}

    __device__ void run() {
        for (std::uint32_t i = bodies_.firstEvent[root_]; i != none; i = bodies_.nextEvent[i]) {
            push(bodies_.events[i]);
        }
        while (size_ > 0 && !failed_) {
            const PairEvent event = popFirst();
            if (!isCurrent(event)) continue;
            if (++happened > mostEvents) fail(trouble::crowded);
            if (!resolve(event)) continue;
            follow(event.a, event.time);
            if (!event.withStatic()) follow(event.b.row(), event.time);
        }
    }

    std::uint32_t happened = 0, collisions = 0;

  private:
    static constexpr int room = 40;
    /// So few that no body can be jammed (collision/continuous/bursts.hpp).
    static constexpr std::uint32_t mostEvents = 64;
    static constexpr int mostDeep = 16;

    __device__ void fail(std::uint32_t why) {
        report(bodies_.counts, why);
        failed_ = true;
    }

    __device__ void push(const PairEvent& event) {
        if (size_ < room) {
            queue_[size_++] = event;
        } else {
            fail(trouble::crowded);
        }
    }
    __device__ PairEvent popFirst() {
        int first = 0;
        for (int i = 1; i < size_; ++i) {
            if (isLater_(queue_[first], queue_[i])) first = i;
        }
        const PairEvent event = queue_[first];
        queue_[first] = queue_[--size_];
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
            if (separated_[i].a == event.a && separated_[i].b == event.b) return true;
        }
        if (deep_ == mostDeep) {
            fail(trouble::crowded);
            return true;
        }
        separated_[deep_++] = {event.a, event.b};
        return false;
    }

    /// Returns whether any path changed.
    __device__ bool resolve(const PairEvent& event) {
        const EventContact contact = contactOf(motion_, event);
        if (contact.deep && separatedAlready(event)) return false;
        // Nothing is pushed along where nothing is lost.
        const EventOutcomes done =
            collide(motion_, event, contact, [](int, double) { return 0.0; });
        if (!done.changes()) return false;
        changed(event.a);
        if (!event.withStatic()) changed(event.b.row());
        if (done.collided() != 0) {
            ++collisions;
            if (bodies_.records != nullptr) keep(event, makeRecord(event, contact, done));
        }
        return true;
    }
    __device__ void changed(std::uint32_t row) {
        ++bodies_.stamps[row];
        bodies_.changedIn[row] = window_.number;
        bodies_.sketches[row] = sketchOf(motion_, row, bodies_.lists.from);
        if (outruns(motion_, row, window_.from, bodies_.horizon, SpeedBounds{bodies_.bound})) {
            fail(trouble::tooFast);
        }
    }
    __device__ void keep(const PairEvent& event, const ContactRecord& record) {
        if (kept_ == 0 || isLater_(event, after_)) after_ = event;
        const std::uint32_t place = countUp(&bodies_.counts->records.value);
        if (place < bodies_.recordRoom) {
            bodies_.records[place] = {after_, kept_, record};
        } else {
            fail(trouble::records);
        }
        ++kept_;
    }

    /// Finds what happens next to a body in this window, with static ones and those of its island.
    __device__ void follow(std::uint32_t row, double now) {
        const SketchSpan span = sketchSpan(bodies_.lists.from, now, window_.to, bodies_.slack);
        const auto ours = [&](std::uint32_t other) { return bodies_.parents[other] == root_; };
        forEachNear(bodies_, row, span, ours, [&](BodyRef other) {
            const BodyRef one[1] = {other};
            findFor(motion_, row, one, now, window_.to, [&](PairEvent event) {
                event.stampA = bodies_.stamps[event.a];
                if (!event.withStatic()) event.stampB = bodies_.stamps[event.b.row()];
                push(event);
            });
        });
    }

    struct Pair {
        std::uint32_t a;
        BodyRef b;
    };

    const EventBodies<Real>& bodies_;
    const ExactMotion<Real, StraightPath>& motion_;
    const Window& window_;
    const EventOrder isLater_;
    const std::uint32_t root_;
    PairEvent queue_[room];
    int size_ = 0;
    Pair separated_[mostDeep];
    int deep_ = 0;
    double instant_ = -1;  // s
    PairEvent after_;      // that the last contact counts as
    std::uint32_t kept_ = 0;
    bool failed_ = false;
};

template <class Real>
__global__ void __launch_bounds__(islandBlock)
    islandsKernel(EventBodies<Real> bodies, Window window) {
    if (troubled(bodies.counts)) return;
    const std::uint32_t islands = bodies.counts->islands.value;
    unsigned long long happened = 0;
    unsigned long long collisions = 0;
    for (std::uint32_t i = threadNumber(); i < islands; i += threadCount()) {
        Island<Real> island(bodies, window, bodies.roots[i]);
        island.run();
        happened += island.happened;
        collisions += island.collisions;
    }
    __syncthreads();
    addFromBlock(&bodies.counts->happened, happened);
    addFromBlock(&bodies.counts->collisions, collisions);
}

/// Lists what the bodies that have changed do in later windows, or takes the changes back; there
/// are no islands afterwards.
template <class Real>
__global__ void __launch_bounds__(largestBlock)
    finishKernel(EventBodies<Real> bodies, Window window, WindowResult* result) {
    const auto& m = bodies.motion.bodies.moving;
    const std::uint32_t troubles = bodies.counts->troubles.value;
    const std::uint32_t claimed = min(bodies.counts->claimed.value, bodies.claimedRoom);
    const SketchSpan span = sketchSpan(bodies.lists.from, window.to, bodies.horizon, bodies.slack);
    for (std::uint32_t i = threadNumber(); i < claimed; i += threadCount()) {
        const std::uint32_t row = bodies.claimed[i];
        bodies.parents[row] = none;
        bodies.firstEvent[row] = none;
        if (bodies.changedIn[row] != window.number) continue;
        if (troubles != 0) {
            m.anchors[row] = bodies.before[i];
            m.vx[row] = bodies.before[i].vx;
            m.vy[row] = bodies.before[i].vy;
            bodies.sketches[row] = sketchOf(bodies.motion, row, bodies.lists.from);
            continue;
        }
        // Of two bodies that both have changed, the first one's thread does it.
        const auto mine = [&](std::uint32_t other) {
            return !(bodies.changedIn[other] == window.number & other < row);
        };
        forEachNear(bodies, row, span, mine, [&](BodyRef other) {
            const BodyRef one[1] = {other};
            findFor(bodies.motion, row, one, window.to, bodies.horizon,
                    [&](const PairEvent& event) {
                        if (event.time > window.to) listMeeting(bodies.lists, event);
                    });
        });
    }
    if (threadNumber() == 0) {
        *result = {.troubles = troubles,
                   .entries = bodies.lists[window.list].count->value,
                   .events = bodies.counts->events.value,
                   .claimed = bodies.counts->claimed.value,
                   .records = bodies.counts->records.value,
                   .happened = bodies.counts->happened,
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
    groupKernel<<<blocksToFill(launch, expected.claimed), size, 0, launch.stream>>>(bodies);
    checkLaunch("groupKernel");
    const unsigned islandBlocks =
        std::min(launch.multiprocessors * 16u, blocksFor(expected.events, islandBlock));
    islandsKernel<<<islandBlocks, islandBlock, 0, launch.stream>>>(bodies, window);
    checkLaunch("islandsKernel");
    finishKernel<<<blocksToFill(launch, expected.claimed), size, 0, launch.stream>>>(bodies, window,
                                                                                     result);
    checkLaunch("finishKernel");
}

#define QUADRILLE_INSTANTIATE(Real)                                                 \
    template void runWindow(const Launch&, const EventBodies<Real>&, const Window&, \
                            const WindowExpectation&, WindowResult*);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille::cuda
