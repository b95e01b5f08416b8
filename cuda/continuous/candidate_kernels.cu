#include "collision/rules/next_event.hpp"
#include "cuda/continuous/candidate_kernels.hpp"
#include "cuda/continuous/window_lists.cuh"
#include "cuda/device/launch.cuh"
#include "cuda/device/warp_tasks.cuh"

namespace quadrille::cuda {

namespace {

/// Raises a number that stands for a double >= 0, for all threads of a warp; they all must come.
__device__ void raiseFromWarp(unsigned long long* highest, double value) {
    auto bits = static_cast<unsigned long long>(__double_as_longlong(value));
    for (unsigned apart = 16; apart > 0; apart /= 2) {
        const unsigned long long other = __shfl_down_sync(0xffff'ffffu, bits, apart);
        bits = other > bits ? other : bits;
    }
    if (threadIdx.x % 32 == 0 && bits > *static_cast<volatile unsigned long long*>(highest)) {
        atomicMax(highest, bits);
    }
}

template <class Real>
__global__ void __launch_bounds__(largestBlock)
    placeAllKernel(ExactMotion<Real, StraightPath> motion, std::uint32_t rows, double time,
                   Survey* survey, PathSketch* sketches) {
    const auto& m = motion.bodies.moving;
    double fastest = 0;
    double farthest = 0;
    for (std::uint32_t row = threadNumber(); row < rows; row += threadCount()) {
        motion.place(row, time);
        if (sketches != nullptr) sketches[row] = sketchOf(motion, row, time);
        fastest = fmax(fastest, fmax(fabs(double(m.vx[row])), fabs(double(m.vy[row]))));
        farthest = fmax(farthest, fmax(fabs(double(m.x[row])), fabs(double(m.y[row]))));
    }
    __syncwarp();
    raiseFromWarp(&survey->fastest, fastest);
    raiseFromWarp(&survey->farthest, farthest);
}

template <class Real>
__global__ void __launch_bounds__(largestBlock)
    countNeighboursKernel(EventBodies<Real> bodies, const CandidatePair* pairs,
                          std::uint32_t* counts) {
    const unsigned long long count = bodies.found->candidates;
    if (count > bodies.pairRoom) return;
    for (std::uint32_t i = threadNumber(); i < count; i += threadCount()) {
        const CandidatePair pair = pairs[i];
        atomicAdd(&counts[pair.a], 1u);
        if (!pair.b.isStatic()) atomicAdd(&counts[pair.b.row()], 1u);
    }
}

template <class Real>
__global__ void __launch_bounds__(largestBlock)
    linkAndFindKernel(EventBodies<Real> bodies, const CandidatePair* pairs, std::uint32_t* ends,
                      BodyRef* others, double now) {
    extern __shared__ CandidatePair nearPairs[];
    const unsigned long long count = bodies.found->candidates;
    if (count > bodies.pairRoom) return;
    WarpTasks<CandidatePair> waiting(nearPairs + threadIdx.x / 32 * WarpTasks<CandidatePair>::room);
    const auto find = [&](const CandidatePair& pair) {
        findNext(bodies.motion, pair.a, bodies.motion.paths(pair.a), pair.b,
                 bodies.motion.paths(pair.b), now, bodies.horizon, false,
                 [&](const PairEvent& event) { listMeeting(bodies.lists, event); });
    };
    const SketchSpan span = sketchSpan(now, now, bodies.horizon, bodies.slack);
    for (std::uint32_t first = threadNumber() / 32 * 32; first < count; first += threadCount()) {
        const std::uint32_t i = first + threadIdx.x % 32;
        const bool there = i < count;
        const CandidatePair pair = pairs[there ? i : first];
        bool near = there;
        if (there) {
            others[atomicSub(&ends[pair.a], 1u) - 1] = pair.b;
            if (!pair.b.isStatic()) {
                others[atomicSub(&ends[pair.b.row()], 1u) - 1] = BodyRef::moving(pair.a);
                near = isNear(bodies.sketches[pair.a], bodies.sketches[pair.b.row()],
                              sketchSize(bodies.motion, pair.a),
                              sketchSize(bodies.motion, pair.b.row()), span);
            }
        }
        waiting.add(near, pair, find);
    }
    waiting.flush(find);
}

}  // namespace

template <class Real>
void placeAll(const Launch& launch, const ExactMotion<Real, StraightPath>& motion,
              std::uint32_t rows, double time, Survey* survey, PathSketch* sketches) {
    placeAllKernel<<<blocksToFill(launch, rows), launch.options.blockSize, 0, launch.stream>>>(
        motion, rows, time, survey, sketches);
    checkLaunch("placeAllKernel");
}

template <class Real>
void countNeighbours(const Launch& launch, const EventBodies<Real>& bodies,
                     const CandidatePair* pairs, std::uint32_t expected, std::uint32_t* counts) {
    countNeighboursKernel<<<blocksToFill(launch, expected), launch.options.blockSize, 0,
                            launch.stream>>>(bodies, pairs, counts);
    checkLaunch("countNeighboursKernel");
}

template <class Real>
void linkAndFind(const Launch& launch, const EventBodies<Real>& bodies, const CandidatePair* pairs,
                 std::uint32_t expected, std::uint32_t* ends, BodyRef* others, double now) {
    const int size = launch.options.blockSize;
    const std::size_t shared = size / 32 * WarpTasks<CandidatePair>::room * sizeof(CandidatePair);
    linkAndFindKernel<<<blocksToFill(launch, expected), size, shared, launch.stream>>>(
        bodies, pairs, ends, others, now);
    checkLaunch("linkAndFindKernel");
}

#define QUADRILLE_INSTANTIATE(Real)                                                              \
    template void placeAll(const Launch&, const ExactMotion<Real, StraightPath>&, std::uint32_t, \
                           double, Survey*, PathSketch*);                                        \
    template void countNeighbours(const Launch&, const EventBodies<Real>&, const CandidatePair*, \
                                  std::uint32_t, std::uint32_t*);                                \
    template void linkAndFind(const Launch&, const EventBodies<Real>&, const CandidatePair*,     \
                              std::uint32_t, std::uint32_t*, BodyRef*, double);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille::cuda
