#pragma once

#include <cuda_runtime.h>
#include <gtest/gtest.h>

/// What tests need that call kernels themselves.

namespace quadrille {

inline void check(cudaError_t error) {
    if (error != cudaSuccess) FAIL() << cudaGetErrorString(error);
}

inline bool hasDevice() {
    int count = 0;
    return cudaGetDeviceCount(&count) == cudaSuccess && count > 0;
}

}  // namespace quadrille
