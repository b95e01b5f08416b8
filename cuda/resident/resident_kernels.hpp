#pragma once

#include <cstdint>

#include "cuda/bodies/body_kernels.hpp"
#include "cuda/device/launch.hpp"

namespace quadrille::cuda {

/// What the host is told of a step.
struct ResidentCounts {
    StepCounts step;
    std::uint32_t entries;  ///< in cells
    std::uint32_t badRow;   ///< the lowest whose position is not finite, else `none`
};

/// Makes the lists of contacts of the touched bodies empty again, and writes the counts to the
/// host's page-locked memory.
void finishStep(const Launch& launch, std::uint32_t* heads, const TouchedBodies& touched,
                const std::uint32_t* entries, const std::uint32_t* badRow, ResidentCounts* result,
                std::uint32_t expected);

}  // namespace quadrille::cuda
