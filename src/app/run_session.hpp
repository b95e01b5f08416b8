#pragma once

#include <chrono>
#include <iosfwd>
#include <optional>

#include <quadrille/quadrille.hpp>

#include "accuracy/error_meter.hpp"
#include "app/options.hpp"
#include "app/output_file.hpp"
#include "app/recorders.hpp"
#include "app/run_setup.hpp"
#include "app/run_statistics.hpp"
#include "app/summary.hpp"

namespace quadrille::app {

/// Where the words of a run go: stdout, unless data goes there.
std::ostream& wordsOf(const Options& options);

/// A run with what is measured and written of it, be there a window or not.
class RunSession {
  public:
    /// Throws Error if an output cannot be written: that should fail now and not after the run.
    RunSession(Run run, const Options& options);
    RunSession(const RunSession&) = delete;
    RunSession& operator=(const RunSession&) = delete;

    Run& run() { return run_; }
    const Run& run() const { return run_; }
    Simulation& simulation() { return run_.simulation; }
    const Simulation& simulation() const { return run_.simulation; }
    RunStatistics& statistics() { return statistics_; }
    const RunStatistics& statistics() const { return statistics_; }
    const Conserved& start() const { return start_; }

    /// One frame.
    const StepReport& step();

    /// Whether --frames ends the run here.
    bool allFramesDone() const;
    /// Whether --duration does.
    bool timeIsUp() const;

    /// Prints the summary and writes every output. Returns the program's exit code.
    int finish();

  private:
    using Clock = std::chrono::steady_clock;

    Run run_;
    const Options& options_;
    std::optional<OutputFile> json_, state_;
    std::optional<FrameRecorder> frames_;
    std::optional<EventRecorder> events_;
    std::optional<accuracy::ErrorMeter> meter_;
    Conserved start_;
    RunStatistics statistics_;
    Clock::time_point begin_;
};

}  // namespace quadrille::app
