#pragma once

#include "cuda/continuous/device_window.hpp"
#include "cuda/device/launch.hpp"

namespace quadrille::cuda {

/// Finds the events of a window, and carries out those that concern nobody but their bodies. Others
/// are left to islands.
template <class Real>
void runEvents(const Launch& launch, const EventBodies<Real>& bodies, const Window& window,
               const WindowExpectation& expected);

}  // namespace quadrille::cuda
