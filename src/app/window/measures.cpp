#include "app/window/measures.hpp"

namespace quadrille::app {

namespace {

constexpr double interval = 0.25;  // s

}  // namespace

void Measures::update(const Workbench& bench) {
    ++pictures_;
    const auto now = Clock::now();
    const double elapsed = std::chrono::duration<double>(now - last_).count();
    const std::uint64_t steps = bench.session().statistics().frames();
    const bool otherRun = bench.runVersion() != runVersion_;
    const bool changed = otherRun || bench.cellsVersion() != cellsVersion_ || steps != steps_;
    if (!otherRun && !(changed && bench.paused()) && elapsed < interval) return;
    if (elapsed >= interval || otherRun) {
        stepsPerSecond = otherRun ? 0 : double(steps - lastSteps_) / elapsed;
        picturesPerSecond = double(pictures_ - lastPictures_) / elapsed;
        last_ = now;
        lastPictures_ = pictures_;
        lastSteps_ = steps;
    }
    if (!changed) return;
    runVersion_ = bench.runVersion();
    cellsVersion_ = bench.cellsVersion();
    steps_ = steps;
    const Simulation& simulation = bench.simulation();
    load = loadOf(simulation.cells());
    histogram = loadHistogram(simulation.cells());
    energyDrift = relativeDrift(bench.session().start().total,
                                totalEnergy(simulation.world(), simulation.config().step.gravity));
}

}  // namespace quadrille::app
