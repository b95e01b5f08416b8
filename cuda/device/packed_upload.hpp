#pragma once

#include <cstddef>
#include <cstdint>
#include <cuda_runtime_api.h>
#include <span>
#include <vector>

#include "cuda/device/memory.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille::cuda {

/// Several arrays that go to the device together: gathered in one block of page-locked memory, and
/// sent in one copy. `add` all, then `flatten`, then `send`; `on` says where each then lies.
class PackedUpload {
  public:
    explicit PackedUpload(MemoryBudget& budget) : device_(budget) {}

    void clear() {
        parts_.clear();
        bytes_ = 0;
    }

    /// Returns the number of the part.
    template <class T>
    std::size_t add(std::span<const T> values) {
        parts_.push_back({std::as_bytes(values).data(), values.size_bytes(), bytes_});
        // As cudaMalloc aligns.
        bytes_ = (bytes_ + values.size_bytes() + 255) / 256 * 256;
        return parts_.size() - 1;
    }

    /// Copies all parts into the block.
    void flatten(const ThreadTeam& team);
    /// Starts the copy to the device. The block must not be flattened anew until it is done.
    void send(cudaStream_t stream);

    /// The part in device memory; null if it is empty.
    template <class T>
    T* on(std::size_t part) const {
        if (parts_[part].bytes == 0) return nullptr;
        return reinterpret_cast<T*>(device_.data() + parts_[part].offset);
    }

    /// The same part in the block, where it stays until the next call of `flatten`.
    template <class T>
    const T* onHost(std::size_t part) const {
        if (parts_[part].bytes == 0) return nullptr;
        return reinterpret_cast<const T*>(host_.data() + parts_[part].offset);
    }

    std::size_t hostBytes() const { return host_.bytes(); }

  private:
    struct Part {
        const std::byte* source;
        std::size_t bytes;
        std::size_t offset;
    };
    std::vector<Part> parts_;
    std::size_t bytes_ = 0;
    PinnedArray<std::byte> host_;
    DeviceArray<std::byte> device_;
};

}  // namespace quadrille::cuda
