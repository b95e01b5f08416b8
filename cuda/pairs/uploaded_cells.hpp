#pragma once

#include <cstddef>
#include <cstdint>

#include "collision/broad/partitioner.hpp"
#include "collision/phase_clock.hpp"
#include "cuda/device/device_session.hpp"
#include "cuda/device/packed_upload.hpp"
#include "cuda/pairs/pair_kernels.hpp"

namespace quadrille::cuda {

/// A copy of the cells that the host makes, sent when they were made anew.
template <class Real>
class UploadedCells {
  public:
    /// `device` must outlive this.
    explicit UploadedCells(DeviceSession& device) : device_(device) {}

    void update(const Partition<Real>& partition, PhaseClock& clock);

    const DeviceCells& cells() const { return cells_; }
    const CellOwnership<Real>& ownership() const { return ownership_; }

    /// Of page-locked host memory.
    std::size_t hostBytes() const { return upload_.hostBytes(); }

  private:
    DeviceSession& device_;
    PackedUpload upload_{device_.budget()};
    DeviceCells cells_{};
    CellOwnership<Real> ownership_{};
    std::uint64_t generation_ = 0;  // of the partition whose cells are here
};

}  // namespace quadrille::cuda
