#pragma once

#include <cstdint>

#include "collision/rules/bodies.hpp"
#include "collision/rules/keep_out.hpp"
#include "collision/rules/static_map_view.hpp"
#include "cuda/bodies/body_kernels.hpp"
#include "cuda/device/launch.hpp"
#include "cuda/pairs/pair_kernels.hpp"

namespace quadrille::cuda {

/// What the host is told of a step.
struct ResidentCounts {
    StepCounts step;
    std::uint32_t entries;  ///< in cells
    std::uint32_t badRow;   ///< the lowest whose position is not finite, else `none`
};

/// Notes by rows where the bodies with contacts stood when the step began; before the contacts are
/// resolved.
template <class Real>
void noteStarts(const Launch& launch, const Bodies<Real>& bodies,
                const DeviceContacts<Real>& contacts, Real dt, Place<Real>* starts,
                std::uint32_t expected);

/// Keeps the touched bodies out of static boxes.
template <class Real>
void keepTouchedOut(const Launch& launch, const Bodies<Real>& bodies, const TouchedBodies& touched,
                    const StaticMapView<Real>& map, const Place<Real>* starts,
                    std::uint32_t expected);

/// Makes the lists of contacts of the touched bodies empty again, and writes the counts to the
/// host's page-locked memory.
void finishStep(const Launch& launch, std::uint32_t* heads, const TouchedBodies& touched,
                const std::uint32_t* entries, const std::uint32_t* badRow, ResidentCounts* result,
                std::uint32_t expected);

}  // namespace quadrille::cuda
