#pragma once

#include <cstdint>
#include <cuda_runtime_api.h>

#include <quadrille/cuda_options.hpp>

namespace quadrille::cuda {

/// Threads in a block at most, which every kernel must have registers for.
inline constexpr int largestBlock = 1024;

/// No row, contact or entry: the end of a list.
inline constexpr std::uint32_t none = 0xffff'ffffu;

/// How and where kernels are started. All work goes to the stream and is not waited for; errors are
/// DeviceErrors. Where a launch is told what is `expected`, it is made for so many items, and
/// treats any number of them.
struct Launch {
    cudaStream_t stream;
    CudaOptions options;
    unsigned multiprocessors;
};

}  // namespace quadrille::cuda
