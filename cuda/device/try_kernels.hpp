#pragma once

#include <cuda_runtime_api.h>

namespace quadrille::cuda {

/// Error of the driver if kernels cannot run on the device, as on one of another architecture.
cudaError_t tryKernels();

}  // namespace quadrille::cuda
