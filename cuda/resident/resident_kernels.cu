#include "cuda/device/launch.cuh"
#include "cuda/resident/resident_kernels.hpp"

namespace quadrille::cuda {

namespace {

__global__ void __launch_bounds__(largestBlock)
    finishStepKernel(std::uint32_t* heads, TouchedBodies touched, const std::uint32_t* entries,
                     const std::uint32_t* badRow, ResidentCounts* result) {
    for (std::uint32_t i = threadNumber(); i < touched.counts->touched; i += threadCount()) {
        heads[touched.rows[i]] = none;
    }
    if (threadNumber() == 0) *result = {*touched.counts, *entries, *badRow};
}

}  // namespace

void finishStep(const Launch& launch, std::uint32_t* heads, const TouchedBodies& touched,
                const std::uint32_t* entries, const std::uint32_t* badRow, ResidentCounts* result,
                std::uint32_t expected) {
    finishStepKernel<<<blocksToFill(launch, expected), launch.options.blockSize, 0,
                       launch.stream>>>(heads, touched, entries, badRow, result);
    checkLaunch("finishStepKernel");
}

}  // namespace quadrille::cuda
