#pragma once

#include <quadrille/detail/host_device.hpp>

/// Motion between contacts, for host and device alike: v += g dt, then x += v dt.

namespace quadrille {

template <class Real>
QUADRILLE_HD inline Real accelerated(Real velocity, Real gravity, Real dt) {
    return velocity + gravity * dt;
}

template <class Real>
QUADRILLE_HD inline Real moved(Real position, Real velocity, Real dt) {
    return position + velocity * dt;
}

}  // namespace quadrille
