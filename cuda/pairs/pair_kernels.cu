#include "collision/rules/cell_ownership.hpp"
#include "collision/rules/pair_geometry.hpp"
#include "cuda/device/launch.cuh"
#include "cuda/device/warp_tasks.cuh"
#include "cuda/pairs/pair_kernels.hpp"

// The narrow phase: which pairs of bodies overlap.

namespace quadrille::cuda {

namespace {

/// Keeps the pairs for later steps.
template <class Real>
struct ToCandidates {
    CandidateList list;

    __device__ void operator()(std::uint32_t a, BodyRef b) const {
        const unsigned long long place = countUp(&list.counts->candidates);
        if (place < list.capacity) list.pairs[place] = {a, b};
    }
};

/// Makes contacts of the pairs and puts them into the lists of their bodies.
template <class Real>
struct ToContacts {
    DeviceContacts<Real> list;
    Bodies<Real> bodies;
    Real dt;

    __device__ void operator()(std::uint32_t a, BodyRef b) const {
        if (list.seen.slots != nullptr && seenBefore(a, b)) return;
        const unsigned long long place = countUp(&list.counts->contacts);
        if (place >= list.capacity) return;  // the host makes room and comes again
        const auto i = static_cast<std::uint32_t>(place);
        const PendingContact<Real> c = b.isStatic() ? staticContact(bodies, a, b.row(), dt)
                                                    : movingContact(bodies, a, b.row(), dt);
        list.contacts[i] = c;
        // The contact's own a and b: the pair stands in the order of rows, the contact in that of
        // creation.
        list.nextA[i] = atomicExch(&list.heads[c.a], i);
        if (!c.b.isStatic()) list.nextB[i] = atomicExch(&list.heads[c.b.row()], i);
        if (list.starts == nullptr) return;
        list.starts[c.a] = placeBefore<Real>(bodies.moving, c.a, dt);
        if (!c.b.isStatic()) {
            list.starts[c.b.row()] = placeBefore<Real>(bodies.moving, c.b.row(), dt);
        }
    }

  private:
    /// Whether the pair is in the table, where it is in any case afterwards. Once there are more
    /// contacts than room the table may be full, and all that follow are said to be in it.
    __device__ bool seenBefore(std::uint32_t a, BodyRef b) const {
        const unsigned long long key = static_cast<unsigned long long>(a) << 32 | b.bits;
        for (std::uint32_t slot = pairPriority(a, b.bits), tries = 1;; ++slot, ++tries) {
            const unsigned long long there =
                atomicCAS(&list.seen.slots[slot & list.seen.mask], SeenPairs::empty, key);
            if (there == SeenPairs::empty) return false;
            if (there == key) return true;
            if (tries % 32 == 0 && atomicAdd(&list.counts->contacts, 0ull) > list.capacity) {
                return true;
            }
        }
    }
};

/// A member of a cell.
template <class Real>
struct Member {
    BodyRef body;
    Box<Real> box;

    __device__ Member(const Bodies<Real>& bodies, const DeviceCells& cells, std::uint32_t entry)
        : body(cells.bodies[entry]), box(boxOf(bodies, body)) {}
};

/// Whether members p and q of a cell overlap, p standing before q; two static ones never do.
template <class Real>
__device__ bool membersOverlap(const Member<Real>& p, const Member<Real>& q, Real inflation) {
    const bool swap = q.body.isStatic();
    const Box<Real>& first = swap ? q.box : p.box;
    const Box<Real>& second = swap ? p.box : q.box;
    return !p.body.isStatic() & overlap(inflated(first, inflation), second);
}

/// Hands out a pair of members that overlap, p standing before q, if it belongs to this cell.
template <class Real, class Found>
__device__ void handOut(const CellOwnership<Real>& ownership, std::uint32_t cell,
                        const Member<Real>& p, const Member<Real>& q, const Found& found) {
    if (ownership.coordinates != nullptr) {
        const auto edges = [&](const Member<Real>& m) {
            const Box<Real> box = inflated(m.box, ownership.margin);
            return crossedEdgesOf(
                ownership.coordinates[cell],
                ownership.grid.range(box.x, box.y, box.halfWidth, box.halfHeight));
        };
        if (!belongsToCell(edges(p), edges(q))) return;
    }
    found(p.body.row(), q.body);
}

/// The cell of an entry: the last that begins at or before it. Empty cells begin where the next
/// one does, so it is one that holds the entry.
__device__ inline std::uint32_t cellOf(const DeviceCells& cells, std::uint32_t entry) {
    if (cells.cellOfEntry != nullptr) return cells.cellOfEntry[entry];
    std::uint32_t low = 0;
    std::uint32_t high = cells.cells;
    while (high - low > 1) {
        const std::uint32_t middle = low + (high - low) / 2;
        if (cells.offsets[middle] <= entry) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

/// A pair of entries of a cell that has been found.
struct FoundPair {
    std::uint32_t cell, p, q;
};
using FoundPairs = WarpTasks<FoundPair>;

/// A thread for each body in each cell. Member i meets the half of the others that follow it, the
/// first after the last, so that all members have as much to do.
template <class Real, class Found>
__global__ void __launch_bounds__(largestBlock)
    comparePerBody(Bodies<Real> bodies, DeviceCells cells, CellOwnership<Real> ownership,
                   Real inflation, Found found, StepCounts* counts) {
    extern __shared__ FoundPair foundPairs[];
    FoundPairs waiting(foundPairs + threadIdx.x / 32 * FoundPairs::room);
    const auto handOutPair = [&](const FoundPair& pair) {
        handOut(ownership, pair.cell, Member<Real>(bodies, cells, pair.p),
                Member<Real>(bodies, cells, pair.q), found);
    };

    unsigned long long tested = 0;
    const std::uint32_t entries = cells.offsets[cells.cells];
    if (entries > cells.entries || blockIdx.x * blockDim.x >= entries) return;
    const bool there = threadNumber() < entries;
    const std::uint32_t entry = there ? threadNumber() : entries - 1;
    const std::uint32_t cell = cellOf(cells, entry);
    const std::uint32_t first = cells.offsets[cell];
    const std::uint32_t members = cells.offsets[cell + 1] - first;
    const std::uint32_t i = entry - first;
    const Member<Real> self(bodies, cells, entry);
    // Opposite members of an even number meet once.
    const std::uint32_t partners =
        there ? (members - 1) / 2 + (members % 2 == 0 && 2 * i < members) : 0;
    const auto partner = [&](std::uint32_t k) { return i + k < members ? i + k : i + k - members; };
    const std::uint32_t most = __reduce_max_sync(0xffff'ffffu, partners);
    // Several pairs are compared before one is handed out, so that their loads overlap.
    const auto compare = [&]<std::uint32_t together>(std::uint32_t start) {
        std::uint32_t hits = 0;
#pragma unroll
        for (std::uint32_t l = 0; l < together; ++l) {
            const bool inside = start + l <= partners;
            const std::uint32_t j = partner(inside ? start + l : 0);
            const Member<Real> other(bodies, cells, first + j);
            const bool hit = i < j ? membersOverlap(self, other, inflation)
                                   : membersOverlap(other, self, inflation);
            tested += inside && !(self.body.isStatic() && other.body.isStatic());
            hits |= std::uint32_t(inside && hit) << l;
        }
        for (; __any_sync(0xffff'ffffu, hits != 0); hits &= hits - 1) {
            const std::uint32_t j = partner(start + __ffs(static_cast<int>(hits)) - 1);
            waiting.add(hits != 0, {cell, first + min(i, j), first + max(i, j)}, handOutPair);
        }
        return start + together;
    };
    for (std::uint32_t start = 1; start <= most;) {
        start = most - start < 2   ? compare.template operator()<2>(start)
                : most - start < 4 ? compare.template operator()<4>(start)
                                   : compare.template operator()<8>(start);
    }
    waiting.flush(handOutPair);
    if (counts != nullptr) addFromBlock(&counts->tested, tested);
}

/// A thread for each cell, as in the report.
template <class Real, class Found>
__global__ void __launch_bounds__(largestBlock)
    comparePerCell(Bodies<Real> bodies, DeviceCells cells, CellOwnership<Real> ownership,
                   Real inflation, Found found, StepCounts* counts) {
    unsigned long long tested = 0;
    const std::uint32_t cell = threadNumber();
    if (cell < cells.cells && cells.offsets[cells.cells] <= cells.entries) {
        const std::uint32_t last = cells.offsets[cell + 1];
        for (std::uint32_t i = cells.offsets[cell]; i < last; ++i) {
            const Member<Real> self(bodies, cells, i);
            if (self.body.isStatic()) break;
            for (std::uint32_t j = i + 1; j < last; ++j) {
                const Member<Real> other(bodies, cells, j);
                ++tested;
                if (membersOverlap(self, other, inflation)) {
                    handOut(ownership, cell, self, other, found);
                }
            }
        }
    }
    if (counts != nullptr) addFromBlock(&counts->tested, tested);
}

template <class Real, class Found>
void comparePairs(const Launch& launch, const Bodies<Real>& bodies, const DeviceCells& cells,
                  const CellOwnership<Real>& ownership, Real inflation, const Found& found,
                  StepCounts* counts) {
    if (cells.entries == 0) return;
    const int size = launch.options.blockSize;
    if (launch.options.threadPer == CudaThread::Cell) {
        comparePerCell<<<blocksFor(cells.cells, size), size, 0, launch.stream>>>(
            bodies, cells, ownership, inflation, found, counts);
    } else {
        const std::size_t shared = size / 32 * FoundPairs::room * sizeof(FoundPair);
        comparePerBody<<<blocksFor(cells.entries, size), size, shared, launch.stream>>>(
            bodies, cells, ownership, inflation, found, counts);
    }
    checkLaunch("comparePairs");
}

template <class Real>
__global__ void __launch_bounds__(largestBlock)
    testCandidatesKernel(Bodies<Real> bodies, const CandidatePair* candidates, std::uint32_t count,
                         ToContacts<Real> found) {
    const std::uint32_t i = threadNumber();
    if (i >= count) return;
    const CandidatePair pair = candidates[i];
    if (overlap(bodies, pair.a, pair.b)) found(pair.a, pair.b);
}

}  // namespace

template <class Real>
void collectCandidates(const Launch& launch, const Bodies<Real>& bodies, const DeviceCells& cells,
                       const CellOwnership<Real>& ownership, Real inflation,
                       const CandidateList& candidates) {
    comparePairs(launch, bodies, cells, ownership, inflation, ToCandidates<Real>{candidates},
                 nullptr);
}

template <class Real>
void findContacts(const Launch& launch, const Bodies<Real>& bodies, const DeviceCells& cells,
                  const CellOwnership<Real>& ownership, Real dt,
                  const DeviceContacts<Real>& contacts) {
    comparePairs(launch, bodies, cells, ownership, Real(0), ToContacts<Real>{contacts, bodies, dt},
                 contacts.counts);
}

template <class Real>
void testCandidates(const Launch& launch, const Bodies<Real>& bodies,
                    const CandidatePair* candidates, std::uint32_t count, Real dt,
                    const DeviceContacts<Real>& contacts) {
    const int size = launch.options.blockSize;
    testCandidatesKernel<<<blocksFor(count, size), size, 0, launch.stream>>>(
        bodies, candidates, count, ToContacts<Real>{contacts, bodies, dt});
    checkLaunch("testCandidatesKernel");
}

#define QUADRILLE_INSTANTIATE(Real)                                                            \
    template void collectCandidates(const Launch&, const Bodies<Real>&, const DeviceCells&,    \
                                    const CellOwnership<Real>&, Real, const CandidateList&);   \
    template void findContacts(const Launch&, const Bodies<Real>&, const DeviceCells&,         \
                               const CellOwnership<Real>&, Real, const DeviceContacts<Real>&); \
    template void testCandidates(const Launch&, const Bodies<Real>&, const CandidatePair*,     \
                                 std::uint32_t, Real, const DeviceContacts<Real>&);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille::cuda
