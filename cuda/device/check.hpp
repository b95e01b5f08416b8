#pragma once

#include <cuda_runtime_api.h>

namespace quadrille::cuda {

/// Throws DeviceError with what was tried and what the driver says of it.
[[noreturn]] void fail(cudaError_t error, const char* what);

inline void check(cudaError_t error, const char* what) {
    if (error != cudaSuccess) fail(error, what);
}

/// For launches, whose own errors show only afterwards.
inline void checkLaunch(const char* kernel) { check(cudaGetLastError(), kernel); }

}  // namespace quadrille::cuda
