#pragma once

#include <cstdint>
#include <cuda_runtime_api.h>

#include <quadrille/bodies.hpp>

#include "collision/broad/partitioner.hpp"
#include "collision/phase_clock.hpp"
#include "cuda/device/check.hpp"
#include "cuda/device/memory.hpp"
#include "cuda/device/packed_upload.hpp"
#include "cuda/kernels.hpp"
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

/// A copy of bodies and cells on the device, kept up to date with as little copying as possible:
/// bodies are sent when somebody edited them and otherwise moved on the device by the same rule as
/// on the host, cells are sent when they were made, and only bodies that contacts have changed come
/// back.
template <class Real>
class DeviceState {
  public:
    /// `team` does the host's part and must outlive the state.
    DeviceState(const CudaOptions& options, const ThreadTeam& team);

    /// Makes the bodies those of the host, which have just been integrated.
    void beginStep(const BodyView<Real>& view, const StepParameters<Real>& step, PhaseClock& clock);

    /// Makes the cells those of the host. Returns whether they are other ones than in the last
    /// step.
    bool updateCells(const Partition<Real>& partition, std::uint32_t movingCount);

    /// Zeroes a new array. What is copied to the host as it is needs that: the gaps between the
    /// members of its elements are copied, too.
    template <class T>
    void clear(const DeviceArray<T>& array) const {
        check(cudaMemsetAsync(array.data(), 0, array.capacity() * sizeof(T), launch().stream),
              "cudaMemsetAsync");
    }
    /// Zeroes the counts within a step.
    void zeroCounts();
    /// Takes back what the step has done so far on the device, counts included.
    void restart(const BodyView<Real>& view);
    /// Where the step's result is to be published.
    HostResult<Real> hostResult() const;
    /// Waits for the step's work, publishing included, and returns what it counted.
    const StepCounts& finish();
    /// Copies what contacts have changed to the host's bodies; the step has then succeeded.
    void writeBack(const BodyView<Real>& view);

    /// Between these, the device does what belongs to a phase of its own. In a profiled run it
    /// takes the time, so that nothing needs to be waited for but the end of the step.
    void begin(Phase phase);
    void end(Phase phase);

    const Launch& launch() const { return stream_.launch(); }
    const ThreadTeam& team() const { return team_; }
    MemoryBudget& budget() { return budget_; }
    const Bodies<Real>& bodies() const { return bodies_; }
    std::uint32_t movingCount() const { return movingCount_; }
    const DeviceCells& cells() const { return cells_; }
    const CellOwnership<Real>& ownership() const { return ownership_; }
    StepCounts* counts() const { return counts_.data(); }
    TouchedBodies touched() const { return {touchedRows_.data(), counts_.data()}; }
    /// Copies from the device and waits.
    void fetch(void* host, const void* device, std::size_t bytes) const;

    std::size_t bytes() const;

  private:
    void upload(const BodyView<Real>& view);
    StreamTimer& timerOf(Phase phase);

    Stream stream_;
    const ThreadTeam& team_;
    MemoryBudget budget_;
    PhaseClock* clock_ = nullptr;
    StreamTimer copyTimer_, publishTimer_;

    PackedUpload bodyUpload_{budget_};
    Bodies<Real> bodies_{};
    std::uint32_t movingCount_ = 0;
    std::uint64_t revision_ = 0;  // of the host's bodies that are here
    bool valid_ = false;          // the bodies here are those of the host

    PackedUpload cellUpload_{budget_};
    DeviceCells cells_{};
    CellOwnership<Real> ownership_{};
    std::uint64_t generation_ = 0;  // of the partition whose cells are here

    DeviceArray<StepCounts> counts_{budget_};
    DeviceArray<std::uint32_t> touchedRows_{budget_};
    PinnedArray<StepCounts> hostCounts_;
    PinnedArray<std::uint32_t> hostRows_;
    PinnedArray<Real> hostColumns_;  // x, y, vx, vy of the touched bodies
};

}  // namespace quadrille::cuda
