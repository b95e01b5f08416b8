#pragma once

#include <memory>

#include "collision/resolver.hpp"

namespace quadrille {

/// The resolver of a discrete law on a CUDA device; from the folder cuda/, or a stand-in in builds
/// without it. `team` does the host's part and must outlive it. Throws DeviceError if there is no
/// device, Error for impossible options.
template <class Real>
std::unique_ptr<Resolver<Real>> makeCudaResolver(const SimulationConfig& config,
                                                 const ThreadTeam& team);

}  // namespace quadrille
