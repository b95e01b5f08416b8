#include "cuda/device/memory.hpp"

#include <algorithm>
#include <cuda_runtime_api.h>
#include <string>

#include <quadrille/error.hpp>

#include "cuda/device/check.hpp"

namespace quadrille::cuda {

namespace {

std::string megabytes(std::size_t bytes) {
    return std::to_string(bytes) + " bytes (" + std::to_string(bytes >> 20) + " MiB)";
}

[[noreturn]] void failForLackOfMemory(std::size_t wanted, std::size_t free) {
    throw DeviceError("cuda: out of device memory: " + megabytes(wanted) + " wanted, " +
                      megabytes(free) + " free");
}

}  // namespace

void fail(cudaError_t error, const char* what) {
    throw DeviceError("cuda: " + std::string(what) + ": " + cudaGetErrorName(error) + ", " +
                      cudaGetErrorString(error));
}

void* allocateDevice(std::size_t bytes, MemoryBudget& budget) {
    if (budget.limit != 0 && bytes > budget.limit - std::min(budget.used, budget.limit)) {
        failForLackOfMemory(bytes, budget.limit - std::min(budget.used, budget.limit));
    }
    void* data = nullptr;
    const cudaError_t error = cudaMalloc(&data, bytes);
    if (error == cudaErrorMemoryAllocation) {
        cudaGetLastError();  // else the next launch would report it again
        std::size_t free = 0, total = 0;
        check(cudaMemGetInfo(&free, &total), "cudaMemGetInfo");
        failForLackOfMemory(bytes, free);
    }
    check(error, "cudaMalloc");
    budget.used += bytes;
    return data;
}

void freeDevice(void* data, std::size_t bytes, MemoryBudget& budget) noexcept {
    if (data == nullptr) return;
    cudaFree(data);  // fails where the device is lost, which whoever uses it next will hear
    budget.used -= bytes;
}

void* allocatePinned(std::size_t bytes) {
    void* data = nullptr;
    const cudaError_t error = cudaMallocHost(&data, bytes);
    if (error == cudaErrorMemoryAllocation) {
        cudaGetLastError();
        throw DeviceError("cuda: out of page-locked host memory: " + megabytes(bytes) + " wanted");
    }
    check(error, "cudaMallocHost");
    return data;
}

void freePinned(void* data) noexcept {
    if (data != nullptr) cudaFreeHost(data);
}

}  // namespace quadrille::cuda
