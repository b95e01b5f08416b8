#pragma once

#include <cstdint>

namespace quadrille::cuda {

/// Tasks that a warp has found and not done yet. Doing one takes long, and the threads of a warp
/// find different numbers of them, so they share what they have found, 32 at a time.
template <class Task>
class WarpTasks {
  public:
    static constexpr std::uint32_t room = 64;

    /// In shared memory that is the warp's own, with so much room.
    __device__ explicit WarpTasks(Task* ofWarp) : tasks_(ofWarp) {}

    /// All threads of the warp come here together, those that have `found` a task to leave it.
    template <class Do>
    __device__ void add(bool found, const Task& task, const Do& perform) {
        const unsigned all = __ballot_sync(0xffff'ffffu, found);
        const unsigned before = (1u << threadIdx.x % 32) - 1;
        if (found) tasks_[count_ + __popc(all & before)] = task;
        count_ += __popc(all);
        if (count_ >= 32) flush(perform);
    }
    /// Does up to 32 of them, which are all that are left after `add`.
    template <class Do>
    __device__ void flush(const Do& perform) {
        __syncwarp();
        const std::uint32_t size = min(count_, 32u);
        count_ -= size;
        if (threadIdx.x % 32 < size) perform(tasks_[count_ + threadIdx.x % 32]);
        __syncwarp();
    }

  private:
    Task* tasks_;
    std::uint32_t count_ = 0;  // the same in all threads of the warp
};

}  // namespace quadrille::cuda
