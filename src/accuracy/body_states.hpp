#pragma once

#include <span>
#include <vector>

#include <quadrille/simulation.hpp>
#include <quadrille/world.hpp>

#include "accuracy/metrics.hpp"

namespace quadrille::accuracy {

/// The moving bodies in order of creation.
std::vector<BodyState> statesOf(const World& world);

/// The mean side of the moving bodies, px; 1 if there are none.
double meanSide(const World& world);

/// Whether collisions exchange velocities and change nothing else: with equal masses, restitution 1
/// and no gravity.
bool onlyExchanges(const Simulation& simulation);

/// By how much a component of a velocity may differ, px/s. Nothing where velocities are only
/// exchanged. Elsewhere every collision rounds, and half of the digits are left for that to add up:
/// sqrt(epsilon) of the fastest component.
double velocityTolerance(bool exchanged, Precision precision, double fastest);

/// The fastest component of all velocities, px/s.
double fastestComponent(std::span<const BodyState> states);

}  // namespace quadrille::accuracy
