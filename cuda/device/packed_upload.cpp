#include "cuda/device/packed_upload.hpp"

#include <algorithm>
#include <cstring>

#include "cuda/device/check.hpp"

namespace quadrille::cuda {

void PackedUpload::flatten(const ThreadTeam& team) {
    host_.reserve(bytes_);
    device_.reserve(bytes_);
    team.shares(bytes_, &Thresholds::copied, [&](std::size_t begin, std::size_t end, unsigned) {
        for (const Part& part : parts_) {
            const std::size_t first = std::max(begin, part.offset);
            const std::size_t last = std::min(end, part.offset + part.bytes);
            if (first >= last) continue;
            std::memcpy(host_.data() + first, part.source + (first - part.offset), last - first);
        }
    });
}

void PackedUpload::send(cudaStream_t stream) {
    if (bytes_ == 0) return;
    check(cudaMemcpyAsync(device_.data(), host_.data(), bytes_, cudaMemcpyHostToDevice, stream),
          "copy to the device");
}

}  // namespace quadrille::cuda
