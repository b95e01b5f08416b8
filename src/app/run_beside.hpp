#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <quadrille/quadrille.hpp>

#include "accuracy/run_comparison.hpp"
#include "app/run_setup.hpp"
#include "app/run_statistics.hpp"
#include "app/summary.hpp"

namespace quadrille::app {

/// What is said of a time at which both runs have arrived; the first run is first.
struct ComparedFrame {
    std::uint64_t frame = 0;  ///< of the first run
    accuracy::Divergence divergence;
    std::array<double, 2> milliseconds{};  ///< of the steps since the time before
    std::array<std::uint64_t, 2> stateHash{};
};

/// The run beside a session's, with which --compare holds it together in simulated time. The steps
/// of the two may differ in length; they are compared whenever they meet.
class RunBeside {
  public:
    /// Throws UsageError if their steps never meet. `first` must live for as long as this.
    RunBeside(Simulation& first, std::unique_ptr<Run> run);

    Run& run() { return *run_; }
    const Run& run() const { return *run_; }
    const RunStatistics& statistics() const { return statistics_; }
    const Conserved& start() const { return start_; }

    /// Makes the steps that the first run has made already, after one of its steps.
    void follow();

    /// Steps of the first run from one common time to the next.
    std::uint64_t stepsPerMeeting() const { return firstPerMeeting_; }
    /// Whether both have arrived at one time.
    bool met() const { return firstSteps_ % firstPerMeeting_ == 0; }

    /// Says what the step of the first run took, in ms, and compares the two if they have met.
    void compare(double milliseconds);

    /// The last comparison, or null before the first.
    const ComparedFrame* last() const { return last_ ? &*last_ : nullptr; }

    /// Of the last comparison, for each moving body in order of creation: whether its velocity
    /// differs.
    std::span<const std::uint8_t> wrong() const { return comparison_.wrong(); }

  private:
    Simulation& first_;
    std::unique_ptr<Run> run_;
    RunStatistics statistics_;
    accuracy::RunComparison comparison_;
    Conserved start_;
    std::uint64_t firstPerMeeting_ = 1, secondPerMeeting_ = 1;  // steps
    std::uint64_t firstSteps_ = 0, secondSteps_ = 0;
    std::array<double, 2> milliseconds_{};  // since the last meeting
    std::optional<ComparedFrame> last_;
};

}  // namespace quadrille::app
