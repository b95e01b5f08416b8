#include "app/run_session.hpp"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include <quadrille/names.hpp>

#include "app/comparison_summary.hpp"
#include "app/error_summary.hpp"
#include "app/exit_code.hpp"
#include "app/interrupt.hpp"
#include "app/step_time.hpp"

namespace quadrille::app {

namespace {

/// A snapshot is opened at the end of the run, too late to say that it cannot be.
void requireWritable(const std::string& snapshot) { const WholeFile probe(snapshot); }

using namespace std::chrono_literals;

/// How long a frame may go on after a signal, at the least. What it would take to repeat the frames
/// since the checkpoint is as well spent on waiting for this one.
constexpr auto leastGrace = 100ms;
/// Between checkpoints, at the least, and times what one costs.
constexpr auto leastAge = 50ms;
constexpr int ageByCost = 10;

}  // namespace

std::ostream& wordsOf(const Options& options) {
    // Data on stdout must not be mixed with words.
    const bool dataOnStdout = options.json == "-" || options.csv == "-" ||
                              options.dumpState == "-" || options.dumpEvents == "-";
    return dataOnStdout ? std::cerr : std::cout;
}

RunSession::RunSession(Run run, const Options& options)
    : run_(std::move(run)),
      options_(options),
      stepsBefore_(run_.simulation.stepsDone()),
      watch_({.takeOver = [this](int signal) { return leaveFrame(signal); },
              .progress = [this](auto inFrame) { showProgress(inFrame); }}) {
    if (!options.json.empty()) json_.emplace(options.json);
    if (!options.dumpState.empty()) state_.emplace(options.dumpState);
    if (!options.save.empty()) requireWritable(options.save);
    if (run_.beside) beside_.emplace(run_.simulation, std::move(run_.beside));
    if (!options.csv.empty() && beside_) comparison_.emplace(options.csv);
    if (!options.csv.empty() && !beside_) frames_.emplace(options.csv);
    if (!options.dumpEvents.empty()) events_.emplace(options.dumpEvents);
    if (options.error) meter_.emplace(run_.simulation);
    start_ = Conserved::of(run_.simulation);
    begin_ = Clock::now();
}

const StepReport& RunSession::step() {
    keepCheckpoint();
    std::optional<TimedStep> step;
    std::chrono::duration<double> followed{};
    const auto age = Clock::now() - checkpoint_->taken;
    watch_.section(std::max<Clock::duration>(leastGrace, age), [&] {
        step.emplace(timedStep(run_.simulation));
        const auto stepped = Clock::now();
        if (meter_) meter_->follow();
        followed = Clock::now() - stepped;
        if (beside_) beside_->follow();
    });
    if (std::exchange(progressShown_, false)) progressLine().wipe();
    const StepReport& report = step->report;
    const double milliseconds = step->milliseconds;
    errorSeconds_ = followed.count() + report.auditSeconds;
    statistics_.add(report, milliseconds);
    if (beside_) beside_->compare(milliseconds);
    if (events_) {
        for (const Contact& contact : run_.simulation.contacts()) events_->record(contact);
    }
    if (frames_) frames_->record(run_.simulation, report, milliseconds);
    if (comparison_ && beside_->met()) comparison_->record(*beside_->last());
    keepSnapshot();
    return report;
}

void RunSession::reconfigure(const SimulationConfig& config) {
    run_.simulation.reconfigure(config);
    checkpoint_.reset();
}

/// Only now and then: what it costs to repeat the frames since is less than to copy each.
void RunSession::keepCheckpoint() {
    const auto before = Clock::now();
    if (checkpoint_) {
        // Frames that depend on the age of a tree cannot be repeated from the bodies alone.
        const SimulationConfig& config = checkpoint_->config;
        const bool repeats = config.law != Law::Baseline && !mayMissPairs(config.partitioner);
        const auto due = std::max<Clock::duration>(leastAge, ageByCost * checkpoint_->cost);
        if (repeats && before - checkpoint_->taken < due) return;
    }
    checkpoint_.reset();  // two at once would take as much again
    checkpoint_ = {run_.simulation.snapshot(), run_.simulation.config(), before, {}};
    checkpoint_->cost = Clock::now() - before;
}

/// What --save-every asks for. Where the end of the run is near, that writes the last one.
void RunSession::keepSnapshot() {
    if (!options_.saveEvery || statistics_.frames() % *options_.saveEvery != 0) return;
    if (allFramesDone() || interruptedBy() != 0) return;
    const auto before = Clock::now();
    try {
        save(run_);
        snapshotFailed_ = false;
    } catch (const Error& error) {
        // The results are not lost for it, and the snapshot of the end may succeed.
        if (!std::exchange(snapshotFailed_, true)) {
            progressLine().wipe();
            std::cerr << "collisionStress: warning: " << error.what() << "; the run goes on\n";
        }
    }
    // To repeat the frames since the checkpoint takes no longer for it.
    checkpoint_->taken += Clock::now() - before;
}

void RunSession::save(const Run& run) const {
    saveSnapshot(options_.save, run.simulation, run.scene, run.seed);
}

/// The end of a run that hangs in a frame: its simulation is out of reach, and another one repeats
/// what came after the checkpoint.
int RunSession::leaveFrame(int signal) {
    SimulationConfig config = checkpoint_->config;
    // The device may be what hangs; the result is the same.
    if (needsDevice(config.resolver)) config.resolver = ResolverKind::Sequential;
    config.keepContacts = false;
    config.countMissedPairs = false;
    Run run{.scene = run_.scene,
            .seed = run_.seed,
            .requestedResolver = run_.requestedResolver,
            .simulation = Simulation(std::move(checkpoint_->snapshot.world), config),
            .beside = nullptr};
    run.simulation.resumeAt(checkpoint_->snapshot.stepsDone);
    run.simulation.run(stepsBefore_ + statistics_.frames() - run.simulation.stepsDone());
    progressLine().wipe();
    return conclude(run, signal, true);
}

void RunSession::showProgress(std::chrono::duration<double> inFrame) {
    progressShown_ = true;
    progressLine().show(statistics_.frames(), elapsed(), inFrame.count());
}

bool RunSession::allFramesDone() const {
    return options_.frames && statistics_.frames() >= *options_.frames;
}

double RunSession::elapsed() const {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
}

bool RunSession::timeIsUp() const { return options_.duration && elapsed() >= *options_.duration; }

int RunSession::finish() {
    // A signal that comes later than the last frame interrupts nothing.
    return conclude(run_, allFramesDone() || timeIsUp() ? 0 : interruptedBy(), false);
}

int RunSession::conclude(const Run& run, int signal, bool insideFrame) {
    auto summary = summaryJson(run, statistics_, start_);
    summary["interrupted"] = signal != 0;
    // A window always measures the phases, for its panels.
    if (!options_.profile) summary["phases_ms"] = nullptr;
    std::ostream& words = wordsOf(options_);
    printSummary(words, summary);
    if (meter_) {
        summary["error"] = nullptr;  // ended before the first frame, or inside one
        if (statistics_.frames() > 0 && !insideFrame) {
            summary["error"] = errorJson(meter_->metrics());
            printError(words, summary["error"]);
        }
    }
    if (beside_) {
        summary["comparison"] = comparisonJson(insideFrame);
        printComparison(words, summary["comparison"]);
    }
    if (frames_) frames_->commit();
    if (comparison_) comparison_->commit();
    if (events_) events_->commit();
    if (state_) writeState(*state_, run.simulation.world());
    if (!options_.save.empty()) save(run);
    if (json_) {
        json_->stream() << summary.dump(2) << '\n';
        json_->commit();
    }
    return signal != 0 ? interruptedBySignal + signal : done;
}

/// With what the run beside came to, unless it is left inside a frame.
nlohmann::ordered_json RunSession::comparisonJson(bool insideFrame) const {
    nlohmann::ordered_json beside;
    if (!insideFrame) {
        beside = summaryJson(beside_->run(), beside_->statistics(), beside_->start());
    }
    return app::comparisonJson({options_.label, options_.beside->label}, beside_->last(),
                               std::move(beside));
}

}  // namespace quadrille::app
