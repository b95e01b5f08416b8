#include "app/window/measures.hpp"

namespace quadrille::app {

namespace {

constexpr double interval = 0.25;  // s

/// Looking for the deepest overlap may take this share of the time.
constexpr int overlapShare = 50;

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
        const std::uint64_t collisions = bench.session().statistics().collisions();
        const double time = bench.simulation().time();
        if (otherRun || time != lastTime_) {
            collisionsPerSecond =
                otherRun ? 0 : double(collisions - lastCollisions_) / (time - lastTime_);
        }
        lastCollisions_ = collisions;
        lastTime_ = time;
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
    escaped = quadrille::escaped(simulation.world());
    updateOverlap(simulation.world(), otherRun);
}

void Measures::updateOverlap(const World& world, bool otherRun) {
    const auto before = Clock::now();
    if (!otherRun && before < overlapDue_) return;
    deepestOverlap = overlap(world).max;
    overlapKnown = true;
    const auto after = Clock::now();
    overlapDue_ = after + overlapShare * (after - before);
}

}  // namespace quadrille::app
