#include "cuda/packed_upload.hpp"

#include <cstring>

#include "cuda/check.hpp"

namespace quadrille::cuda {

void PackedUpload::flatten() {
    host_.reserve(bytes_);
    device_.reserve(bytes_);
    for (const Part& part : parts_) {
        if (part.bytes > 0) std::memcpy(host_.data() + part.offset, part.source, part.bytes);
    }
}

void PackedUpload::send(cudaStream_t stream) {
    if (bytes_ == 0) return;
    check(cudaMemcpyAsync(device_.data(), host_.data(), bytes_, cudaMemcpyHostToDevice, stream),
          "copy to the device");
}

}  // namespace quadrille::cuda
