#include "collision/rules/discrete_motion.hpp"
#include "cuda/bodies/body_kernels.hpp"
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
    integrate(m.x[row], m.vx[row], step.gravityX, step.dt);
    integrate(m.y[row], m.vy[row], step.gravityY, step.dt);
}

}  // namespace

template <class Real>
void launchBeginStep(const Launch& launch, const Bodies<Real>& bodies, std::uint32_t movingCount,
                     const StepParameters<Real>& step, StepCounts* counts) {
    const int size = launch.options.blockSize;
    beginStepKernel<<<blocksFor(movingCount, size), size, 0, launch.stream>>>(bodies, movingCount,
                                                                              step, counts);
    checkLaunch("beginStepKernel");
}

template void launchBeginStep(const Launch&, const Bodies<double>&, std::uint32_t,
                              const StepParameters<double>&, StepCounts*);
template void launchBeginStep(const Launch&, const Bodies<float>&, std::uint32_t,
                              const StepParameters<float>&, StepCounts*);

}  // namespace quadrille::cuda
