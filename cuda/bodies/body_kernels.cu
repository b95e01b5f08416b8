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

template <class Real>
__global__ void __launch_bounds__(largestBlock)
    takePlacesKernel(Bodies<Real> bodies, HostResult<Real> result, std::uint32_t count) {
    const std::uint32_t i = threadNumber();
    if (i >= count) return;
    bodies.moving.x[result.rows[i]] = result.x[i];
    bodies.moving.y[result.rows[i]] = result.y[i];
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

template <class Real>
void launchTakePlaces(const Launch& launch, const Bodies<Real>& bodies,
                      const HostResult<Real>& result, std::uint32_t count) {
    if (count == 0) return;
    const int size = launch.options.blockSize;
    takePlacesKernel<<<blocksFor(count, size), size, 0, launch.stream>>>(bodies, result, count);
    checkLaunch("takePlacesKernel");
}

template void launchBeginStep(const Launch&, const Bodies<double>&, std::uint32_t,
                              const StepParameters<double>&, StepCounts*);
template void launchBeginStep(const Launch&, const Bodies<float>&, std::uint32_t,
                              const StepParameters<float>&, StepCounts*);
template void launchTakePlaces(const Launch&, const Bodies<double>&, const HostResult<double>&,
                               std::uint32_t);
template void launchTakePlaces(const Launch&, const Bodies<float>&, const HostResult<float>&,
                               std::uint32_t);

}  // namespace quadrille::cuda
