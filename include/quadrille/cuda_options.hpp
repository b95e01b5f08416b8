#pragma once

#include <cstddef>
#include <cstdint>

namespace quadrille {

/// What one thread of the device looks after when the resolver `cuda` compares the bodies of the
/// cells. The result is the same.
enum class CudaThread : std::uint8_t {
    Cell,  ///< all pairs of a cell, as the report's program does
    Body,  ///< the pairs of one body in one cell, so that crowded cells are shared by many threads
};

/// How the resolver `cuda` uses its device. Nothing here changes the result.
struct CudaOptions {
    CudaThread threadPer = CudaThread::Body;
    int blockSize = 128;          ///< threads in a block: a multiple of 32, from 32 to 1024
    std::size_t memoryLimit = 0;  ///< bytes of device memory to use at most; 0 is no limit
};

}  // namespace quadrille
