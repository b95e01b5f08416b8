#include "app/run_session.hpp"

#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/error_summary.hpp"
#include "app/exit_code.hpp"
#include "app/interrupt.hpp"

namespace quadrille::app {

namespace {

/// A snapshot is opened at the end of the run, too late to say that it cannot be.
void requireWritable(const std::string& snapshot) { const WholeFile probe(snapshot); }

}  // namespace

std::ostream& wordsOf(const Options& options) {
    // Data on stdout must not be mixed with words.
    const bool dataOnStdout = options.json == "-" || options.csv == "-" ||
                              options.dumpState == "-" || options.dumpEvents == "-";
    return dataOnStdout ? std::cerr : std::cout;
}

RunSession::RunSession(Run run, const Options& options) : run_(std::move(run)), options_(options) {
    if (!options.json.empty()) json_.emplace(options.json);
    if (!options.dumpState.empty()) state_.emplace(options.dumpState);
    if (!options.save.empty()) requireWritable(options.save);
    if (!options.csv.empty()) frames_.emplace(options.csv);
    if (!options.dumpEvents.empty()) {
        events_.emplace(options.dumpEvents);
        run_.simulation.onContact([this](const Contact& contact) { events_->record(contact); });
    }
    if (options.error) meter_.emplace(run_.simulation);
    start_ = Conserved::of(run_.simulation);
    begin_ = Clock::now();
}

const StepReport& RunSession::step() {
    const auto before = Clock::now();
    const StepReport& report = run_.simulation.step();
    const std::chrono::duration<double> seconds = Clock::now() - before;
    const double milliseconds =
        1e3 * (seconds.count() - report.auditSeconds - report.observeSeconds);
    statistics_.add(report, milliseconds);
    if (meter_) meter_->follow();
    if (frames_) frames_->record(run_.simulation, report, milliseconds);
    return report;
}

bool RunSession::allFramesDone() const {
    return options_.frames && statistics_.frames() >= *options_.frames;
}

bool RunSession::timeIsUp() const {
    if (!options_.duration) return false;
    const std::chrono::duration<double> elapsed = Clock::now() - begin_;
    return elapsed.count() >= *options_.duration;
}

int RunSession::finish() {
    // A signal that comes later than the last frame interrupts nothing.
    const int signal = allFramesDone() || timeIsUp() ? 0 : interruptedBy();
    auto summary = summaryJson(run_, statistics_, start_);
    summary["interrupted"] = signal != 0;
    // A window always measures the phases, for its panels.
    if (!options_.profile) summary["phases_ms"] = nullptr;
    std::ostream& words = wordsOf(options_);
    printSummary(words, summary);
    if (meter_) {
        summary["error"] = nullptr;  // ended before the first frame
        if (statistics_.frames() > 0) {
            summary["error"] = errorJson(meter_->metrics());
            printError(words, summary["error"]);
        }
    }
    if (frames_) frames_->commit();
    if (events_) events_->commit();
    if (state_) writeState(*state_, run_.simulation.world());
    if (!options_.save.empty()) {
        saveSnapshot(options_.save, run_.simulation, run_.scene, run_.seed);
    }
    if (json_) {
        json_->stream() << summary.dump(2) << '\n';
        json_->commit();
    }
    return signal != 0 ? interruptedBySignal + signal : done;
}

}  // namespace quadrille::app
