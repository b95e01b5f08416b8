#pragma once

#include <quadrille/detail/host_device.hpp>

#include "collision/rules/pair_contact.hpp"
#include "collision/rules/paths.hpp"

/// How near bodies must be to meet within a stretch of time, for host and device alike: bounds that
/// leave room for what is rounded.

namespace quadrille {

/// How far a body of at most `bound` px/s along an axis may be, after `life` s, from where it was:
/// with the rounding of positions, in events and by up to `edits` edits, and what counts as
/// touching, px. `farthest` is the largest coordinate up to then, `largest` the largest half
/// extent.
template <class Real>
QUADRILLE_HD inline double reachOfLife(double bound, double life, double farthest, double largest,
                                       int edits) {
    const double eps = (8 + 0.5 * edits) * machineEpsilon<Real>;
    return bound * life * (1 + 1e-6) + eps * farthest + 2 * touchTolerance * largest;
}

/// How near two bodies that are no faster than `fastest` may get to each other until `to`, `span` s
/// after they were where they are, px: both get on by the fastest's way at most, and what touches,
/// or rests on what has just left, is near.
template <class Real>
QUADRILLE_HD inline double islandWay(double fastest, double span, double to, double farthest,
                                     double largest, bool falls) {
    constexpr double eps = 64 * machineEpsilon<Real>;
    constexpr double epsTime = 64 * machineEpsilon<double>;
    const double touching = falls ? 1e-5 : 4 * touchTolerance;
    return 2 * fastest * span + eps * farthest + epsTime * fastest * magnitude(to) +
           touching * largest;
}

/// Whether two bodies are less than their size and a way apart along an axis.
template <class Real>
QUADRILLE_HD inline bool isNear(double a, double b, double halfA, double halfB, double way) {
    constexpr double rounded = 1 + 64 * machineEpsilon<Real>;
    return magnitude(b - a) < (halfA + halfB) * rounded + way;
}

}  // namespace quadrille
