#pragma once

#include <chrono>

#include <quadrille/simulation.hpp>

namespace quadrille::app {

struct TimedStep {
    const StepReport& report;  ///< of the simulation, until its next step
    double milliseconds;       ///< without audit and listeners
};

inline TimedStep timedStep(Simulation& simulation) {
    const auto before = std::chrono::steady_clock::now();
    const StepReport& report = simulation.step();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - before;
    return {report, 1e3 * (taken.count() - report.auditSeconds - report.observeSeconds)};
}

}  // namespace quadrille::app
