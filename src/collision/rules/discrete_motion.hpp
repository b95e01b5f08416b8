#pragma once

#include <quadrille/detail/host_device.hpp>

/// Motion between contacts of the discrete laws, for host and device alike.

namespace quadrille {

/// A step along one axis: v += g dt, then x += v dt. Nothing is added to the velocity where there
/// is no gravity: adding 0 would turn -0 into 0.
template <class Real>
QUADRILLE_HD inline void integrate(Real& position, Real& velocity, Real gravity, Real dt) {
    if (gravity != 0) velocity = velocity + gravity * dt;
    position = position + velocity * dt;
}

}  // namespace quadrille
