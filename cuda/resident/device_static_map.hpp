#pragma once

#include <cstddef>

#include "collision/static_map.hpp"
#include "cuda/device/device_session.hpp"
#include "cuda/device/packed_upload.hpp"

namespace quadrille::cuda {

/// The host's map of static boxes, on the device.
template <class Real>
class DeviceStaticMap {
  public:
    /// `device` must outlive this.
    explicit DeviceStaticMap(DeviceSession& device) : device_(device), upload_(device.budget()) {}

    /// Makes the map that of these bodies, and sends it if it is another one than before. The
    /// device must be done with what it was sent before.
    void load(const BodyView<Real>& bodies);

    bool empty() const { return map_.empty(); }
    /// In device memory; of a map that is not empty.
    const StaticMapView<Real>& view() const { return view_; }

    /// Of host memory.
    std::size_t hostBytes() const { return map_.bytes() + upload_.hostBytes(); }

  private:
    DeviceSession& device_;
    StaticMap<Real> map_;
    PackedUpload upload_;
    StaticMapView<Real> view_{};
};

}  // namespace quadrille::cuda
