#include "collision/motion.hpp"
#include "cuda/launch.cuh"

namespace quadrille::cuda {

namespace {

template <class Real>
__global__ void beginStepKernel(ImpulseBodies<Real> bodies, std::uint32_t movingCount,
                                StepParameters<Real> step, StepCounts* counts) {
    const std::uint32_t row = threadNumber();
    if (row == 0) *counts = {};
    if (row >= movingCount) return;
    const auto& m = bodies.moving;
    // Adding 0 would turn a velocity of -0 into 0.
    if (step.gravityX != 0) m.vx[row] = accelerated(m.vx[row], step.gravityX, step.dt);
    if (step.gravityY != 0) m.vy[row] = accelerated(m.vy[row], step.gravityY, step.dt);
    m.x[row] = moved(m.x[row], m.vx[row], step.dt);
    m.y[row] = moved(m.y[row], m.vy[row], step.dt);
}

template <class Real>
__global__ void publishKernel(ImpulseBodies<Real> bodies, TouchedBodies touched,
                              HostResult<Real> result) {
    const auto& m = bodies.moving;
    for (std::uint32_t i = threadNumber(); i < touched.counts->touched; i += threadCount()) {
        const std::uint32_t row = touched.rows[i];
        result.rows[i] = row;
        result.x[i] = m.x[row];
        result.y[i] = m.y[row];
        result.vx[i] = m.vx[row];
        result.vy[i] = m.vy[row];
    }
    if (threadNumber() == 0) *result.counts = *touched.counts;
}

}  // namespace

cudaError_t tryKernels() {
    cudaFuncAttributes attributes;
    const cudaError_t error = cudaFuncGetAttributes(&attributes, beginStepKernel<double>);
    cudaGetLastError();
    return error;
}

template <class Real>
void beginStep(const Launch& launch, const ImpulseBodies<Real>& bodies, std::uint32_t movingCount,
               const StepParameters<Real>& step, bool advance, StepCounts* counts) {
    const std::uint32_t rows = advance ? movingCount : 0;
    const int size = launch.options.blockSize;
    beginStepKernel<<<blocksFor(rows, size), size, 0, launch.stream>>>(bodies, rows, step, counts);
    checkLaunch("beginStepKernel");
}

template <class Real>
void publish(const Launch& launch, const ImpulseBodies<Real>& bodies, const TouchedBodies& touched,
             const HostResult<Real>& result, std::uint32_t expected) {
    publishKernel<<<blocksToFill(launch, expected), launch.options.blockSize, 0, launch.stream>>>(
        bodies, touched, result);
    checkLaunch("publishKernel");
}

#define QUADRILLE_INSTANTIATE(Real)                                                        \
    template void beginStep(const Launch&, const ImpulseBodies<Real>&, std::uint32_t,      \
                            const StepParameters<Real>&, bool, StepCounts*);               \
    template void publish(const Launch&, const ImpulseBodies<Real>&, const TouchedBodies&, \
                          const HostResult<Real>&, std::uint32_t);
QUADRILLE_INSTANTIATE(double)
QUADRILLE_INSTANTIATE(float)

}  // namespace quadrille::cuda
