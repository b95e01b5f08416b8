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

/// Keeps the touched bodies out of the static boxes of a map, where the contacts have noted where
/// bodies were; makes the lists of contacts of these bodies empty again, and writes the counts to
/// the host's page-locked memory.
template <class Real>
void finishStep(const Launch& launch, const Bodies<Real>& bodies,
                const DeviceContacts<Real>& contacts, const TouchedBodies& touched,
                const StaticMapView<Real>& map, const std::uint32_t* entries,
                const std::uint32_t* badRow, ResidentCounts* result, std::uint32_t expected);

}  // namespace quadrille::cuda
