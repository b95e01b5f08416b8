#include "cuda/device/try_kernels.hpp"

namespace quadrille::cuda {

namespace {

__global__ void emptyKernel() {}

}  // namespace

cudaError_t tryKernels() {
    cudaFuncAttributes attributes;
    const cudaError_t error = cudaFuncGetAttributes(&attributes, emptyKernel);
    cudaGetLastError();
    return error;
}

}  // namespace quadrille::cuda
