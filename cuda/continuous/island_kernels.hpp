#pragma once

#include "cuda/continuous/device_window.hpp"
#include "cuda/device/launch.hpp"

namespace quadrille::cuda {

/// Gathers the events that concern others into islands with all bodies that may have to do with
/// them, and carries them out. What was carried out alone and lies in an island is taken back
/// first.
template <class Real>
void runIslands(const Launch& launch, const EventBodies<Real>& bodies, const Window& window,
                const WindowExpectation& expected);

}  // namespace quadrille::cuda
