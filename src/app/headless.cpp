#include "app/headless.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#ifdef _WIN32
#include <io.h>
#define QUADRILLE_ISATTY(stream) (_isatty(_fileno(stream)) != 0)
#else
#include <unistd.h>
#define QUADRILLE_ISATTY(stream) (isatty(fileno(stream)) != 0)
#endif

#include "accuracy/error_meter.hpp"
#include "app/error_summary.hpp"
#include "app/interrupt.hpp"
#include "app/output_file.hpp"
#include "app/recorders.hpp"
#include "app/run_statistics.hpp"
#include "app/summary.hpp"

namespace quadrille::app {

namespace {

using Clock = std::chrono::steady_clock;

double secondsBetween(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

/// The line that is printed every few seconds, about the frames since the last one.
class PeriodicReport {
  public:
    PeriodicReport(std::ostream& out, const Simulation& simulation, double startEnergy)
        : out_(out), simulation_(simulation), startEnergy_(startEnergy) {}

    void print(const RunStatistics& total) {
        const std::uint64_t frames = total.frames() - frames_;
        if (frames == 0) return;
        const double ms = (total.totalMilliseconds() - milliseconds_) / double(frames);
        const CellLoad cells = load(simulation_.cells());
        const double energy = totalEnergy(simulation_.world(), simulation_.config().gravity);
        std::array<char, 320> line{};
        std::snprintf(line.data(), line.size(),
                      "entities %zu  frames %llu  ms/frame %.4f  frames/s %.1f  cells %zu  "
                      "bodies/cell %.2f mean %zu max  contacts/frame %.1f  energy drift %.3g",
                      simulation_.world().movingCount(),
                      static_cast<unsigned long long>(total.frames()), ms, 1e3 / ms, cells.cells,
                      cells.meanBodies, cells.maxBodies,
                      double(total.contacts() - contacts_) / double(frames),
                      relativeDrift(startEnergy_, energy));
        out_ << line.data() << std::endl;
        frames_ = total.frames();
        milliseconds_ = total.totalMilliseconds();
        contacts_ = total.contacts();
    }

  private:
    std::ostream& out_;
    const Simulation& simulation_;
    double startEnergy_;
    std::uint64_t frames_ = 0, contacts_ = 0;
    double milliseconds_ = 0;
};

/// "frame 120 of 600" on a terminal, wiped when done.
class ProgressLine {
  public:
    explicit ProgressLine(std::optional<std::uint64_t> frames)
        : frames_(frames), shown_(QUADRILLE_ISATTY(stderr) && frames.has_value()) {}
    ~ProgressLine() { wipe(); }

    void show(std::uint64_t frame) {
        if (shown_) std::cerr << "\rframe " << frame << " of " << *frames_ << std::flush;
    }
    void wipe() const {
        if (shown_) std::cerr << "\r\x1b[K" << std::flush;
    }

  private:
    std::optional<std::uint64_t> frames_;
    bool shown_;
};

/// A snapshot is opened at the end of the run, too late to say that it cannot be.
void requireWritable(const std::string& snapshot) {
    std::error_code error;
    const auto status = std::filesystem::status(snapshot, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw Error(snapshot + ": is not a file that a snapshot can replace");
    }
    const OutputFile probe(snapshot);
}

}  // namespace

void runHeadless(Run run, const Options& options) {
    Simulation& simulation = run.simulation;
    // A file that cannot be written should fail now and not after the run.
    std::optional<OutputFile> json;
    if (!options.json.empty()) json.emplace(options.json);
    std::optional<OutputFile> state;
    if (!options.dumpState.empty()) state.emplace(options.dumpState);
    if (!options.save.empty()) requireWritable(options.save);
    std::optional<FrameRecorder> frames;
    if (!options.csv.empty()) frames.emplace(options.csv);
    std::optional<EventRecorder> events;
    if (!options.dumpEvents.empty()) {
        events.emplace(options.dumpEvents);
        simulation.onContact([&](const Contact& contact) { events->record(contact); });
    }

    // Data on stdout must not be mixed with words.
    const bool dataOnStdout = options.json == "-" || options.csv == "-" ||
                              options.dumpState == "-" || options.dumpEvents == "-";
    std::ostream& words = dataOnStdout ? std::cerr : std::cout;

    std::optional<accuracy::ErrorMeter> meter;
    if (options.error) meter.emplace(simulation);

    const Conserved start = Conserved::of(simulation);
    bool deviceFailed = !simulation.resolverFailure().empty();
    RunStatistics statistics;
    PeriodicReport report(words, simulation, start.total);
    ProgressLine progress(options.frames);
    const auto begin = Clock::now();
    auto lastReport = begin;
    auto lastProgress = begin;
    const std::uint64_t frameLimit =
        options.frames.value_or(std::numeric_limits<std::uint64_t>::max());
    while (statistics.frames() < frameLimit && !interrupted()) {
        const auto before = Clock::now();
        const StepReport& step = simulation.step();
        const auto after = Clock::now();
        const double milliseconds =
            1e3 * (secondsBetween(before, after) - step.auditSeconds - step.observeSeconds);
        statistics.add(step, milliseconds);
        if (!deviceFailed && !simulation.resolverFailure().empty()) {
            progress.wipe();
            warnOfFallback(simulation);
            deviceFailed = true;
        }
        if (meter) meter->follow();
        if (frames) frames->record(simulation, step, milliseconds);
        if (secondsBetween(lastProgress, after) >= 0.2) {
            progress.show(statistics.frames());
            lastProgress = after;
        }
        if (secondsBetween(lastReport, after) >= options.reportEvery) {
            progress.wipe();
            report.print(statistics);
            lastReport = after;
        }
        if (options.duration && secondsBetween(begin, after) >= *options.duration) break;
    }
    progress.wipe();
    report.print(statistics);
    auto summary = summaryJson(run, statistics, start);
    printSummary(words, summary);
    if (meter) {
        summary["error"] = nullptr;  // interrupted before the first frame
        if (statistics.frames() > 0) {
            summary["error"] = errorJson(meter->metrics());
            printError(words, summary["error"]);
        }
    }

    if (frames) frames->commit();
    if (events) events->commit();
    if (state) writeState(*state, simulation.world());
    if (!options.save.empty()) saveSnapshot(options.save, simulation, run.scene, run.seed);
    if (json) {
        json->stream() << summary.dump(2) << '\n';
        json->commit();
    }
}

}  // namespace quadrille::app
