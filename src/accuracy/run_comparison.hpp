#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <quadrille/simulation.hpp>

#include "accuracy/metrics.hpp"

namespace quadrille::accuracy {

/// How far two runs from one start are apart at a time; the first is held against the second.
struct Divergence {
    double time = 0;         ///< s since both were the same
    std::size_t bodies = 0;  ///< that move
    std::size_t apart = 0;   ///< whose places differ by more than `apartFrom` of `length`
    std::size_t wrongBodies = 0;
    double velocityTolerance = 0;  ///< px/s; 0: any difference counts
    Quantiles positionError;       ///< over `length`
    double length = 0;             ///< px: the mean side of the moving bodies
    EventMatch events;             ///< settled ones; those of the second run are the exact ones
    std::array<double, 2> overlapMax{};  ///< deepest overlap of each, over `length`

    /// What no rounding adds up to, and hardly anybody sees.
    static constexpr double apartFrom = 0.01;
};

/// Holds a run against another from the same start, as ErrorMeter does against the reference; its
/// collisions, wrong bodies and distances are those of docs/accuracy.md.
class RunComparison {
  public:
    /// Listens to both from here on and must live for as long as they step. Bodies must not be
    /// added, removed or edited meanwhile. Throws Error if they do not have the same moving bodies.
    RunComparison(Simulation& first, Simulation& second);
    RunComparison(const RunComparison&) = delete;
    RunComparison& operator=(const RunComparison&) = delete;

    /// Compares the states; both have come to the same time.
    Divergence measure();

    /// Of the last `measure`, for each moving body in order of creation: whether its velocity
    /// differs.
    std::span<const std::uint8_t> wrong() const { return wrong_; }

  private:
    Simulation& first_;
    Simulation& second_;
    bool exchanged_;
    Precision precision_;              // of the less precise one
    double length_;                    // px
    double firstBegin_, secondBegin_;  // s, where the clock of each stood
    double fastestAtStart_ = 0;
    EventMatcher matcher_;
    std::vector<std::uint8_t> wrong_;
};

}  // namespace quadrille::accuracy
