#pragma once

#include <algorithm>
#include <cooperative_groups.h>
#include <cstdint>

#include "cuda/device/check.hpp"
#include "cuda/device/launch.hpp"

namespace quadrille::cuda {

__device__ inline std::uint32_t threadNumber() { return blockIdx.x * blockDim.x + threadIdx.x; }
__device__ inline std::uint32_t threadCount() { return gridDim.x * blockDim.x; }

/// Counts one up for each of the threads that are here together, with one atomic operation for all
/// of a warp. Returns this thread's number.
template <class T>
__device__ inline T countUp(T* counter) {
    const auto here = cooperative_groups::coalesced_threads();
    T first = 0;
    if (here.thread_rank() == 0) first = atomicAdd(counter, T(here.size()));
    return static_cast<T>(here.shfl(first, 0) + here.thread_rank());
}

/// Adds the sum of a block's values, with one atomic operation. All threads of the block must come.
__device__ inline void addFromBlock(unsigned long long* counter, unsigned long long value) {
    __shared__ unsigned long long sum;
    if (threadIdx.x == 0) sum = 0;
    __syncthreads();
    for (unsigned apart = 16; apart > 0; apart /= 2) {
        value += __shfl_down_sync(0xffff'ffffu, value, apart);
    }
    if (threadIdx.x % 32 == 0 && value != 0) atomicAdd(&sum, value);
    __syncthreads();
    if (threadIdx.x == 0 && sum != 0) atomicAdd(counter, sum);
    __syncthreads();
}

/// Blocks for a kernel in which each thread treats one item.
inline unsigned blocksFor(std::uint32_t items, int blockSize) {
    const auto size = static_cast<std::uint32_t>(blockSize);
    return std::max(1u, items / size + (items % size != 0));
}

/// Blocks for a kernel whose blocks treat several items together and go on to further ones: no more
/// than fill the device.
inline unsigned blocksToFill(const Launch& launch, std::uint32_t items, int itemsOfBlock,
                             int blockSize) {
    const unsigned full = launch.multiprocessors * (2048u / static_cast<unsigned>(blockSize));
    return std::min(full, blocksFor(items, itemsOfBlock));
}

/// The same for one in which each thread treats one item.
inline unsigned blocksToFill(const Launch& launch, std::uint32_t items) {
    return blocksToFill(launch, items, launch.options.blockSize, launch.options.blockSize);
}

/// Starts a kernel whose blocks wait for each other, and so must all be there at once: as many as
/// the items need, at most as many as the device holds.
template <class... Parameters>
void launchTogether(const Launch& launch, const char* name, void (*kernel)(Parameters...),
                    std::uint32_t items, int blockSize, Parameters... parameters) {
    int resident = 0;
    check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&resident, kernel, blockSize, 0), name);
    const unsigned most = launch.multiprocessors * static_cast<unsigned>(std::max(resident, 1));
    void* arguments[] = {&parameters...};
    check(
        cudaLaunchCooperativeKernel(kernel, std::min(most, blocksFor(items, blockSize)),
                                    static_cast<unsigned>(blockSize), arguments, 0, launch.stream),
        name);
}

}  // namespace quadrille::cuda
