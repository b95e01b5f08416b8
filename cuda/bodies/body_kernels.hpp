#pragma once

#include <cstdint>

#include "collision/rules/bodies.hpp"
#include "collision/rules/step_parameters.hpp"
#include "cuda/device/launch.hpp"

namespace quadrille::cuda {

/// What the kernels of a step count.
struct StepCounts {
    unsigned long long tested;      ///< pairs compared
    unsigned long long contacts;    ///< to be listed, whether or not there was room for them
    unsigned long long candidates;  ///< the same of candidate pairs
    unsigned long long collisions;
    unsigned int touched;  ///< bodies that a contact has changed
};

/// The bodies that the contacts of a step have changed.
struct TouchedBodies {
    std::uint32_t* rows;
    StepCounts* counts;
};

/// Where a step's result goes: page-locked host memory.
template <class Real>
struct HostResult {
    StepCounts* counts;
    std::uint32_t* rows;  ///< of the bodies that contacts have changed
    Real *x, *y, *vx, *vy;
};

/// Moves the bodies to the end of a step of a discrete law, and zeroes the counts.
template <class Real>
void launchBeginStep(const Launch& launch, const Bodies<Real>& bodies, std::uint32_t movingCount,
                     const StepParameters<Real>& step, StepCounts* counts);

/// Moves the first `count` bodies of the result to where the host has put them in it.
template <class Real>
void launchTakePlaces(const Launch& launch, const Bodies<Real>& bodies,
                      const HostResult<Real>& result, std::uint32_t count);

}  // namespace quadrille::cuda
