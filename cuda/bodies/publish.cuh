#pragma once

#include "collision/rules/bodies.hpp"
#include "cuda/bodies/body_kernels.hpp"
#include "cuda/device/launch.cuh"

namespace quadrille::cuda {

/// Calls `settle(row)` for each touched body, which may still change it, and writes it to the host.
template <class Real, class Settle>
__global__ void __launch_bounds__(largestBlock)
    publishKernel(Bodies<Real> bodies, TouchedBodies touched, HostResult<Real> result,
                  Settle settle) {
    const auto& m = bodies.moving;
    for (std::uint32_t i = threadNumber(); i < touched.counts->touched; i += threadCount()) {
        const std::uint32_t row = touched.rows[i];
        settle(row);
        result.rows[i] = row;
        result.x[i] = m.x[row];
        result.y[i] = m.y[row];
        result.vx[i] = m.vx[row];
        result.vy[i] = m.vy[row];
    }
    if (threadNumber() == 0) *result.counts = *touched.counts;
}

template <class Real, class Settle>
void publish(const Launch& launch, const Bodies<Real>& bodies, const TouchedBodies& touched,
             const HostResult<Real>& result, std::uint32_t expected, const Settle& settle) {
    publishKernel<<<blocksToFill(launch, expected), launch.options.blockSize, 0, launch.stream>>>(
        bodies, touched, result, settle);
    checkLaunch("publishKernel");
}

}  // namespace quadrille::cuda
