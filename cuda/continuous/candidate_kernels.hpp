#pragma once

#include <cstdint>

#include "cuda/continuous/device_window.hpp"
#include "cuda/device/launch.hpp"

/// What happens to the bodies for as long as a partition lasts.

namespace quadrille::cuda {

/// Places the bodies where they are at a time, surveys them, and sketches their paths as seen from
/// then, if `sketches` is not null.
template <class Real>
void placeAll(const Launch& launch, const ExactMotion<Real, StraightPath>& motion,
              std::uint32_t rows, double time, Survey* survey, PathSketch* sketches);

/// Counts the neighbours of each body, from the pairs that the partition shows.
template <class Real>
void countNeighbours(const Launch& launch, const EventBodies<Real>& bodies,
                     const CandidatePair* pairs, std::uint32_t expected, std::uint32_t* counts);

/// Makes the lists of neighbours, whose ends are given and become their beginnings, and finds in
/// which windows pairs meet.
template <class Real>
void linkAndFind(const Launch& launch, const EventBodies<Real>& bodies, const CandidatePair* pairs,
                 std::uint32_t expected, std::uint32_t* ends, BodyRef* others, double now);

}  // namespace quadrille::cuda
