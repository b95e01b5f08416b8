#include "app/headless.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <optional>
#include <utility>

#include "app/comparison_summary.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/run_session.hpp"

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
        const CellLoad cells = loadOf(simulation_.cells());
        const double energy = totalEnergy(simulation_.world(), simulation_.config().step.gravity);
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

}  // namespace

int runHeadless(Run run, const Options& options) {
    RunSession session(std::move(run), options);
    const Simulation& simulation = session.simulation();
    const RunStatistics& statistics = session.statistics();
    PeriodicReport report(wordsOf(options), simulation, session.start().total);
    std::optional<ComparisonTable> table;
    if (session.beside() != nullptr) {
        table.emplace(wordsOf(options), std::array{options.label, options.beside->label},
                      options.frames);
    }
    const ProgressLine progress(options.frames, options.duration);
    catchInterrupts();
    bool deviceFailed = !simulation.resolverFailure().empty();
    auto lastReport = Clock::now();
    auto lastProgress = lastReport;
    while (!session.allFramesDone() && interruptedBy() == 0) {
        session.step();
        if (table && session.beside()->met()) {
            progress.wipe();
            table->add(*session.beside()->last());
        }
        const auto now = Clock::now();
        if (!deviceFailed && !simulation.resolverFailure().empty()) {
            progress.wipe();
            warnOfFallback(session.run());
            deviceFailed = true;
        }
        if (secondsBetween(lastProgress, now) >= 0.2) {
            progress.show(statistics.frames(), session.elapsed());
            lastProgress = now;
        }
        if (!table && secondsBetween(lastReport, now) >= options.reportEvery) {
            progress.wipe();
            report.print(statistics);
            lastReport = now;
        }
        if (session.timeIsUp()) break;
    }
    progress.wipe();
    if (table) {
        table->finish();
    } else {
        report.print(statistics);
    }
    return session.finish();
}

}  // namespace quadrille::app
