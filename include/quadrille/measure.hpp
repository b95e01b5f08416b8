#pragma once

#include <cstddef>

#include <quadrille/vec2.hpp>
#include <quadrille/world.hpp>

namespace quadrille {

/// Sum of m v^2 / 2 over the moving bodies.
double kineticEnergy(const World& world);

/// Sum of m (v^2 / 2 - g x): kinetic plus potential energy in uniform gravity.
double totalEnergy(const World& world, const Vec2& gravity);

/// Sum of m v over the moving bodies.
Vec2 momentum(const World& world);

/// Moving bodies whose centre lies outside the world.
std::size_t escaped(const World& world);

/// The pairs that overlap now.
struct Overlap {
    std::size_t pairs = 0;
    double max = 0;   ///< deepest penetration, along the axis of least penetration, px
    double mean = 0;  ///< over the overlapping pairs, px
};
Overlap overlap(const World& world);

}  // namespace quadrille
