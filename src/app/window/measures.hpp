#pragma once

#include <chrono>
#include <cstdint>

#include <quadrille/quadrille.hpp>

#include "app/window/load_histogram.hpp"
#include "app/window/workbench.hpp"

namespace quadrille::app {

/// The numbers that the panels show and that cost a pass over bodies or cells; taken a few times a
/// second, and at once where the run stands still.
class Measures {
  public:
    void update(const Workbench& bench);

    CellLoad load;
    LoadHistogram histogram;
    double energyDrift = 0;
    double stepsPerSecond = 0, picturesPerSecond = 0;  ///< of wall time
    double collisionsPerSecond = 0;                    ///< of the simulation's time
    std::size_t escaped = 0;
    /// Of any two boxes, px. It is dear in a crowd, and is looked for less often there.
    double deepestOverlap = 0;
    bool overlapKnown = false;

  private:
    using Clock = std::chrono::steady_clock;

    void updateOverlap(const World& world, bool otherRun);

    Clock::time_point last_, overlapDue_;
    std::uint64_t lastCollisions_ = 0;
    double lastTime_ = 0;
    std::uint64_t pictures_ = 0, lastPictures_ = 0, lastSteps_ = 0;
    std::uint64_t runVersion_ = 0, cellsVersion_ = 0, steps_ = 0;
};

}  // namespace quadrille::app
