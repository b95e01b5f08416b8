#include "app/run_beside.hpp"

#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "app/options.hpp"
#include "app/output_file.hpp"
#include "app/step_time.hpp"

namespace quadrille::app {

namespace {

/// More steps than this until two runs meet are too many to speak of a comparison.
constexpr std::uint64_t mostPerMeeting = 1000;

/// The least numbers of steps of both lengths that take the same time.
std::pair<std::uint64_t, std::uint64_t> stepsUntilMeeting(double first, double second) {
    constexpr double rounding = 1e-9;
    for (std::uint64_t steps = 1; steps <= mostPerMeeting; ++steps) {
        const double others = std::round(double(steps) * first / second);
        if (others < 1 || others > double(mostPerMeeting)) continue;
        if (std::abs(others * second - double(steps) * first) <= rounding * double(steps) * first) {
            return {steps, static_cast<std::uint64_t>(others)};
        }
    }
    throw UsageError("--compare: steps of " + exact(first) + " s and " + exact(second) +
                     " s do not meet within " + std::to_string(mostPerMeeting) + " steps");
}

}  // namespace

RunBeside::RunBeside(Simulation& first, std::unique_ptr<Run> run)
    : first_(first), run_(std::move(run)), comparison_(first, run_->simulation) {
    std::tie(firstPerMeeting_, secondPerMeeting_) =
        stepsUntilMeeting(first.config().step.dt, run_->simulation.config().step.dt);
    start_ = Conserved::of(run_->simulation);
}

void RunBeside::follow() {
    ++firstSteps_;
    // Never ahead of the first run.
    const std::uint64_t due = firstSteps_ * secondPerMeeting_ / firstPerMeeting_;
    for (; secondSteps_ < due; ++secondSteps_) {
        const TimedStep step = timedStep(run_->simulation);
        statistics_.add(step.report, step.milliseconds);
        milliseconds_[1] += step.milliseconds;
    }
}

void RunBeside::compare(double milliseconds) {
    milliseconds_[0] += milliseconds;
    if (!met()) return;
    last_ = ComparedFrame{
        .frame = firstSteps_,
        .divergence = comparison_.measure(),
        .milliseconds = std::exchange(milliseconds_, {}),
        .stateHash = {stateHash(first_.world()), stateHash(run_->simulation.world())}};
}

}  // namespace quadrille::app
