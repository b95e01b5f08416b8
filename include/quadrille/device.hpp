#pragma once

#include <string>

namespace quadrille {

/// The device that the resolver `cuda` would run on.
struct CudaDevice {
    std::string name;    ///< empty if there is none that can be used
    std::string reason;  ///< why there is none

    bool usable() const { return !name.empty(); }
};

/// Looks for the device. The first call in a process may take some tenths of a second.
CudaDevice findCudaDevice();

}  // namespace quadrille
