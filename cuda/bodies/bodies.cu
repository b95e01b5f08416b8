#include "collision/rules/motion.hpp"
#include "cuda/device/launch.cuh"

namespace quadrille::cuda {

namespace {

template <class Real>
__global__ void __launch_bounds__(largestBlock)
    beginStepKernel(Bodies<Real> bodies, std::uint32_t movingCount, StepParameters<Real> step,
                    StepCounts* counts) {
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

}  // namespace

cudaError_t tryKernels() {
    cudaFuncAttributes attributes;
    const cudaError_t error = cudaFuncGetAttributes(&attributes, beginStepKernel<double>);
    cudaGetLastError();
    return error;
}

template <class Real>
void beginStep(const Launch& launch, const Bodies<Real>& bodies, std::uint32_t movingCount,
               const StepParameters<Real>& step, bool advance, StepCounts* counts) {
    const std::uint32_t rows = advance ? movingCount : 0;
    const int size = launch.options.blockSize;
    beginStepKernel<<<blocksFor(rows, size), size, 0, launch.stream>>>(bodies, rows, step, counts);
    checkLaunch("beginStepKernel");
}

template void beginStep(const Launch&, const Bodies<double>&, std::uint32_t,
                        const StepParameters<double>&, bool, StepCounts*);
template void beginStep(const Launch&, const Bodies<float>&, std::uint32_t,
                        const StepParameters<float>&, bool, StepCounts*);

}  // namespace quadrille::cuda
