#include <cuda/atomic>

#include "cuda/bodies/publish.cuh"
#include "cuda/discrete/baseline_kernels.hpp"

// The law `baseline` in parallel with the result of one cell after the other. A cell must wait for
// the earlier cells that hold one of its bodies, and for no others: each body counts its cells that
// are done.

namespace quadrille::cuda {

namespace {

template <class Real>
__global__ void __launch_bounds__(largestBlock)
    linkEntriesKernel(DeviceCells cells, BaselineOrder<Real> order) {
    const std::uint32_t entry = threadNumber();
    if (entry >= cells.entries) return;
    const BodyRef body = cells.bodies[entry];
    if (!body.isStatic()) order.next[entry] = atomicExch(&order.heads[body.row()], entry);
}

template <class Real>
__global__ void __launch_bounds__(largestBlock)
    findCellTurnsKernel(DeviceCells cells, BaselineOrder<Real> order) {
    const std::uint32_t entry = threadNumber();
    if (entry >= cells.entries) return;
    const BodyRef body = cells.bodies[entry];
    if (body.isStatic()) return;
    std::uint32_t earlier = 0;
    for (std::uint32_t e = order.heads[body.row()]; e != none; e = order.next[e]) {
        earlier += e < entry;
    }
    order.turns[entry] = earlier;
}

template <class Real>
__device__ void touch(const BaselineOrder<Real>& order, const TouchedBodies& touched,
                      std::uint32_t row) {
    if (order.hit[row]) return;
    order.hit[row] = true;
    touched.rows[atomicAdd(&touched.counts->touched, 1u)] = row;
}

/// `Lanes` threads, 1 or a warp, share a cell: they compare a member with several others at once,
/// and resolve what they find one by one.
template <class Real, unsigned Lanes>
__global__ void __launch_bounds__(largestBlock)
    resolveBaselineKernel(Bodies<Real> bodies, DeviceCells cells, BaselineOrder<Real> order,
                          Real restitution, TouchedBodies touched) {
    using Done = ::cuda::atomic_ref<std::uint32_t, ::cuda::thread_scope_device>;
    const std::uint32_t lane = threadIdx.x % Lanes;
    const auto together = [] {
        if constexpr (Lanes > 1) __syncwarp();
    };
    const auto lanesThat = [](bool is) -> unsigned {
        if constexpr (Lanes > 1) return __ballot_sync(0xffff'ffffu, is);
        return is;
    };
    const BaselineBodies<Real> withFuture{bodies, order.futureX, order.futureY};
    unsigned long long tested = 0;
    unsigned long long contacts = 0;

    // Cells in ascending order, so that the earliest cell that is left is always somebody's next.
    for (std::uint32_t cell = threadNumber() / Lanes; cell < cells.cells;
         cell += threadCount() / Lanes) {
        const std::uint32_t first = cells.offsets[cell];
        const std::uint32_t end = cells.offsets[cell + 1];
        for (std::uint32_t e = first + lane; e < end; e += Lanes) {
            const BodyRef body = cells.bodies[e];
            if (body.isStatic()) break;
            const Done done(order.done[body.row()]);
            while (done.load(::cuda::memory_order_acquire) != order.turns[e]) {
            }
        }
        together();
        for (std::uint32_t i = first; i < end && !cells.bodies[i].isStatic(); ++i) {
            const std::uint32_t a = cells.bodies[i].row();
            if (lane == 0) tested += end - i - 1;
            for (std::uint32_t base = i + 1; base < end; base += Lanes) {
                const std::uint32_t j = base + lane;
                const auto overlap = [&] {
                    return j < end && quadrille::overlap(bodies, a, cells.bodies[j]);
                };
                unsigned hits = lanesThat(overlap());
                while (hits != 0) {
                    const unsigned next = __ffs(static_cast<int>(hits)) - 1;
                    if (lane == next) {
                        const BodyRef b = cells.bodies[j];
                        const auto outcome = resolveBaseline(withFuture, a, b, restitution);
                        touch(order, touched, a);
                        if (!b.isStatic()) touch(order, touched, b.row());
                        ++contacts;
                        if (order.contacts != nullptr) {
                            const auto place = atomicAdd(&touched.counts->contacts, 1ull);
                            if (place < order.capacity) {
                                order.contacts[place] = {cell, i - first, j - first, a, b, outcome};
                            }
                        }
                    }
                    together();
                    // The pairs that follow see what this one has moved.
                    hits = lanesThat(lane > next && overlap());
                }
            }
        }
        together();
        for (std::uint32_t e = first + lane; e < end; e += Lanes) {
            const BodyRef body = cells.bodies[e];
            if (body.isStatic()) break;
            Done(order.done[body.row()]).store(order.turns[e] + 1, ::cuda::memory_order_release);
        }
    }
    addFromBlock(&touched.counts->tested, tested);
    addFromBlock(&touched.counts->collisions, contacts);
}

/// A body has the velocity that its last contact gave it.
template <class Real>
struct TakeFuture {
    Bodies<Real> bodies;
    BaselineOrder<Real> order;

    __device__ void operator()(std::uint32_t row) const {
        bodies.moving.vx[row] = order.futureX[row];
        bodies.moving.vy[row] = order.futureY[row];
        order.hit[row] = false;
    }
};

}  // namespace

template <class Real>
void findCellTurns(const Launch& launch, const DeviceCells& cells,
                   const BaselineOrder<Real>& order) {
    const int size = launch.options.blockSize;
    const unsigned blocks = blocksFor(cells.entries, size);
    linkEntriesKernel<<<blocks, size, 0, launch.stream>>>(cells, order);
    checkLaunch("linkEntriesKernel");
    findCellTurnsKernel<<<blocks, size, 0, launch.stream>>>(cells, order);
    checkLaunch("findCellTurnsKernel");
}

template <class Real>
void launchBaseline(const Launch& launch, const Bodies<Real>& bodies, const DeviceCells& cells,
                    const BaselineOrder<Real>& order, Real restitution,
                    const TouchedBodies& touched) {
    const int size = launch.options.blockSize;
    if (launch.options.threadPer == CudaThread::Cell) {
        launchTogether(launch, "resolveBaselineKernel", resolveBaselineKernel<Real, 1>, cells.cells,
                       size, bodies, cells, order, restitution, touched);
    } else {
        const std::uint64_t threads = std::uint64_t(cells.cells) * 32;
        launchTogether(launch, "resolveBaselineKernel", resolveBaselineKernel<Real, 32>,
                       static_cast<std::uint32_t>(std::min<std::uint64_t>(threads, none)), size,
                       bodies, cells, order, restitution, touched);
    }
}

template <class Real>
void publishBaseline(const Launch& launch, const Bodies<Real>& bodies,
                     const BaselineOrder<Real>& order, const TouchedBodies& touched,
                     const HostResult<Real>& result, std::uint32_t expected) {
    publish(launch, bodies, touched, result, expected, TakeFuture<Real>{bodies, order});
}

#define QUADRILLE_INSTANTIATE(Real)                                                               \
    template void findCellTurns(const Launch&, const DeviceCells&, const BaselineOrder<Real>&);   \
    template void launchBaseline(const Launch&, const Bodies<Real>&, const DeviceCells&,          \
                                 const BaselineOrder<Real>&, Real, const TouchedBodies&);         \
    template void publishBaseline(const Launch&, const Bodies<Real>&, const BaselineOrder<Real>&, \
                                  const TouchedBodies&, const HostResult<Real>&, std::uint32_t);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille::cuda
