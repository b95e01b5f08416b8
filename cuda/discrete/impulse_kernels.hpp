#pragma once

#include <cstdint>

#include "collision/rules/bodies.hpp"
#include "collision/rules/contact_order.hpp"
#include "collision/rules/step_parameters.hpp"
#include "cuda/bodies/body_kernels.hpp"
#include "cuda/device/launch.hpp"
#include "cuda/pairs/pair_kernels.hpp"

namespace quadrille::cuda {

/// Finds which contacts follow each contact, and for how many it must wait.
template <class Real>
void findSuccessors(const Launch& launch, const DeviceContacts<Real>& contacts,
                    const CanonicalOrder& order, std::uint32_t expected);

/// Resolves each contact after those that it waits for. Does nothing if there was no room for all
/// contacts.
template <class Real>
void launchImpulse(const Launch& launch, const Bodies<Real>& bodies,
                   const DeviceContacts<Real>& contacts, const StepParameters<Real>& step,
                   const TouchedBodies& touched, std::uint32_t expected);

/// Writes the counts, and the bodies that contacts have changed, to the host; makes the lists of
/// these bodies empty again.
template <class Real>
void publishImpulse(const Launch& launch, const Bodies<Real>& bodies,
                    const DeviceContacts<Real>& contacts, const TouchedBodies& touched,
                    const HostResult<Real>& result, std::uint32_t expected);

}  // namespace quadrille::cuda
