#pragma once

#include <memory>

#include <quadrille/config.hpp>

#include "collision/law.hpp"

namespace quadrille {

/// The laws `baseline` and `impulse` on a CUDA device, with the host's partition; from the folder
/// cuda/, or a stand-in in builds without it. `team` does the host's part and must outlive them.
/// Throw DeviceError if there is no device, Error for impossible options.
template <class Real>
std::unique_ptr<ContactLaw<Real>> makeCudaBaseline(const SimulationConfig& config,
                                                   const ThreadTeam& team);
template <class Real>
std::unique_ptr<ContactLaw<Real>> makeCudaImpulse(const SimulationConfig& config,
                                                  const ThreadTeam& team);

}  // namespace quadrille
