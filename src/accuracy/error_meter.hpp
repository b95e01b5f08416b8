#pragma once

#include <memory>

#include <quadrille/simulation.hpp>

#include "accuracy/metrics.hpp"

namespace quadrille::accuracy {

/// Runs the event-driven reference (reference::Oracle, double precision) beside a simulation, from
/// the same start, and measures how far the simulation is from it.
///
/// The start is the simulation's state when the meter is made, after rounding to its precision: the
/// error is that of the steps and not that of the start. Bodies that overlap then, overlap in the
/// reference too, which separates them by the rule that its page states.
///
/// Memory and time of the reference grow with the number of collisions.
class ErrorMeter {
  public:
    /// The reference, as results name it.
    static constexpr const char* reference = "event-driven, double precision";

    /// Listens to the simulation from here on; the meter must live for as long as it steps. Bodies
    /// must not be added, removed or edited meanwhile. Throws Error if the reference refuses them.
    explicit ErrorMeter(Simulation& simulation);
    ~ErrorMeter();
    ErrorMeter(const ErrorMeter&) = delete;
    ErrorMeter& operator=(const ErrorMeter&) = delete;

    /// Brings the reference to the simulation's time. Call it after each step, or after several: a
    /// slice is all that happens between two calls, and slices do not change the result. Throws
    /// Error if the reference cannot go on.
    void follow();

    /// The error so far: of the collisions up to the last follow(), and of the state at that time,
    /// in which the simulation must still be. Throws Error if bodies were added or removed.
    ErrorMetrics metrics() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace quadrille::accuracy
