#pragma once

#include <array>
#include <cstddef>
#include <cuda_runtime_api.h>

#include <quadrille/cuda_options.hpp>

#include "collision/phase_clock.hpp"
#include "cuda/device/check.hpp"
#include "cuda/device/launch.hpp"
#include "cuda/device/memory.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille::cuda {

/// A stream, and what is needed to launch kernels on it. Throws DeviceError if there is no device.
class Stream {
  public:
    explicit Stream(const CudaOptions& options);
    ~Stream();
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    const Launch& launch() const { return launch_; }
    void wait() const;

  private:
    Launch launch_{};
};

/// Takes the time between two points of a stream.
class StreamTimer {
  public:
    StreamTimer() = default;
    ~StreamTimer();
    StreamTimer(const StreamTimer&) = delete;
    StreamTimer& operator=(const StreamTimer&) = delete;

    void start(cudaStream_t stream);
    void stop(cudaStream_t stream);
    /// Of the last time, s; 0 if there was none since the last call. The stream must be done.
    double take();

  private:
    cudaEvent_t from_ = nullptr, to_ = nullptr;
    bool stopped_ = false;
};

/// What all parts of a law share of the device, and the threads that do the host's part beside it.
class DeviceSession {
  public:
    /// `team` must outlive this. Throws DeviceError if there is no device.
    DeviceSession(const CudaOptions& options, const ThreadTeam& team);

    const Launch& launch() const { return stream_.launch(); }
    const ThreadTeam& team() const { return team_; }
    MemoryBudget& budget() { return budget_; }
    std::size_t memoryUsed() const { return budget_.used; }

    void wait() const { stream_.wait(); }
    /// Copies from the device and waits.
    void fetch(void* host, const void* device, std::size_t bytes) const;

    /// Sets all bytes of the first elements.
    template <class T>
    void fill(const DeviceArray<T>& array, int byte, std::size_t count) const {
        if (count == 0) return;
        check(cudaMemsetAsync(array.data(), byte, count * sizeof(T), launch().stream),
              "cudaMemsetAsync");
    }
    template <class T>
    void fill(const DeviceArray<T>& array, int byte) const {
        fill(array, byte, array.capacity());
    }
    template <class T>
    void copy(const DeviceArray<T>& to, const DeviceArray<T>& from, std::size_t count) const {
        check(cudaMemcpyAsync(to.data(), from.data(), count * sizeof(T), cudaMemcpyDeviceToDevice,
                              launch().stream),
              "cudaMemcpyAsync");
    }
    /// Makes room for elements that are copied to the host as they are, for which a new array must
    /// be zeroed: the gaps between their members are copied, too.
    template <class T>
    void reserveZeroed(DeviceArray<T>& array, std::size_t count) const {
        if (array.reserve(count)) fill(array, 0);
    }

    /// Between these, the device does what belongs to another phase than Resolve. In a profiled run
    /// it takes the time, so that nothing needs to be waited for but the end of the step.
    void begin(Phase phase, const PhaseClock& clock);
    void end(Phase phase, const PhaseClock& clock);
    /// Waits for all work, as a part of the phase Resolve, and gives those phases their times.
    void finish(PhaseClock& clock);

  private:
    StreamTimer& timerOf(Phase phase) { return timers_[static_cast<std::size_t>(phase)]; }

    Stream stream_;
    const ThreadTeam& team_;
    MemoryBudget budget_;
    std::array<StreamTimer, phaseCount> timers_;
};

}  // namespace quadrille::cuda
