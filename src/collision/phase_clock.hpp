#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

#include <quadrille/step_report.hpp>

namespace quadrille {

/// Measures the phases of a step one after the other; does nothing unless asked to.
class PhaseClock {
  public:
    using Clock = std::chrono::steady_clock;

    PhaseClock(StepReport& report, bool enabled) : report_(report), enabled_(enabled) {
        if (enabled_) last_ = Clock::now();
    }
    void finish(Phase phase) {
        if (!enabled_) return;
        const auto now = Clock::now();
        report_.phaseSeconds[static_cast<std::size_t>(phase)] +=
            std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

    /// Counts some of the time of one phase, but not more than it has, as another's.
    void move(Phase from, Phase to, double seconds) {
        if (!enabled_) return;
        double& source = report_.phaseSeconds[static_cast<std::size_t>(from)];
        const double moved = std::min(seconds, source);
        source -= moved;
        report_.phaseSeconds[static_cast<std::size_t>(to)] += moved;
    }

    bool enabled() const { return enabled_; }

    /// Leaves out what happened since the last phase.
    void restart() {
        if (enabled_) last_ = Clock::now();
    }

  private:
    StepReport& report_;
    bool enabled_;
    Clock::time_point last_;
};

}  // namespace quadrille
