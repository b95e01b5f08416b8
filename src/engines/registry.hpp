#pragma once

#include <memory>

#include <quadrille/config.hpp>
#include <quadrille/vec2.hpp>

#include "collision/law.hpp"
#include "cuda/resident_pipeline.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// The law as the configuration asks for it; `team` must outlive it. Throws NotAvailable if the law
/// does not run on the resolver, and DeviceError if that needs a device that is not there.
template <class Real>
std::unique_ptr<ContactLaw<Real>> makeLaw(const SimulationConfig& config, const ThreadTeam& team);

/// The same for a resolver whose bodies stay on a device.
template <class Real>
std::unique_ptr<ResidentPipeline<Real>> makeResident(const SimulationConfig& config,
                                                     const Vec2& worldSize, const ThreadTeam& team);

/// Threads that the configuration asks for on the host.
unsigned threadsOf(const SimulationConfig& config);

}  // namespace quadrille
