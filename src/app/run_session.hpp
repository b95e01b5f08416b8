#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include <quadrille/quadrille.hpp>

#include "accuracy/error_meter.hpp"
#include "app/options.hpp"
#include "app/output_file.hpp"
#include "app/progress.hpp"
#include "app/recorders.hpp"
#include "app/run_beside.hpp"
#include "app/run_setup.hpp"
#include "app/run_statistics.hpp"
#include "app/run_watch.hpp"
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
    /// The run that it is compared with, or null.
    RunBeside* beside() { return beside_ ? &*beside_ : nullptr; }
    const RunBeside* beside() const { return beside_ ? &*beside_ : nullptr; }

    /// One frame. A signal ends the program in it if it lasts: with the state, and all outputs, of
    /// the end of the frame before.
    const StepReport& step();

    /// Whether --error compares the run with the reference.
    bool measuresError() const { return meter_.has_value(); }
    /// What that took of the last frame, s.
    double errorSeconds() const { return errorSeconds_; }
    /// How large the error is so far. Throws Error if it cannot be said any more.
    accuracy::ErrorMetrics errorSoFar() const { return meter_.value().metrics(); }

    /// Changes what a step is made with, as Simulation::reconfigure does.
    void reconfigure(const SimulationConfig& config);

    /// Wall time since the start, in s.
    double elapsed() const;
    /// Whether --frames ends the run here.
    bool allFramesDone() const;
    /// Whether --duration does.
    bool timeIsUp() const;

    /// Prints the summary and writes every output. Returns the program's exit code.
    int finish();

  private:
    using Clock = std::chrono::steady_clock;

    /// Where a run can be taken up again that hangs in a frame.
    struct Checkpoint {
        Snapshot snapshot;
        SimulationConfig config;
        Clock::time_point taken;
        Clock::duration cost;
    };

    void keepCheckpoint();
    void keepSnapshot();
    void save(const Run& run) const;
    int leaveFrame(int signal);
    ProgressLine progressLine() const { return {options_.frames, options_.duration}; }
    void showProgress(std::chrono::duration<double> inFrame);
    nlohmann::ordered_json comparisonJson(bool insideFrame) const;
    int conclude(const Run& run, int signal, bool insideFrame);

    Run run_;
    const Options& options_;
    std::uint64_t stepsBefore_ = 0;  // of the run that a snapshot is of
    std::optional<OutputFile> json_, state_;
    std::optional<FrameRecorder> frames_;
    std::optional<ComparisonRecorder> comparison_;
    std::optional<EventRecorder> events_;
    std::optional<accuracy::ErrorMeter> meter_;
    std::optional<RunBeside> beside_;
    double errorSeconds_ = 0;
    Conserved start_;
    RunStatistics statistics_;
    Clock::time_point begin_;
    std::optional<Checkpoint> checkpoint_;
    bool progressShown_ = false;
    bool snapshotFailed_ = false;  // the last one that was due
    RunWatch watch_;               // last, since its thread uses the others
};

}  // namespace quadrille::app
