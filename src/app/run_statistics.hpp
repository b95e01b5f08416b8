#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include <quadrille/simulation.hpp>

namespace quadrille::app {

struct FrameTimes {
    double mean = 0, median = 0, p99 = 0;  ///< ms
};

/// Adds up what the steps of a run report. Memory stays bounded however long it runs.
class RunStatistics {
  public:
    void add(const StepReport& report, double milliseconds);

    std::uint64_t frames() const { return frames_; }
    double totalMilliseconds() const { return totalMilliseconds_; }
    FrameTimes times() const;
    std::array<double, phaseCount> phaseMilliseconds() const;  ///< mean a frame
    std::uint64_t contacts() const { return contacts_; }
    std::uint64_t collisions() const { return collisions_; }
    std::uint64_t pairsTested() const { return pairsTested_; }
    std::uint64_t missedPairs() const { return missedPairs_; }
    std::uint64_t auditedFrames() const { return auditedFrames_; }
    std::uint64_t rebuilds() const { return rebuilds_; }

  private:
    static constexpr std::size_t mostSamples = std::size_t(1) << 22;

    std::uint64_t frames_ = 0;
    double totalMilliseconds_ = 0;
    std::vector<double> samples_;  // ms of every stride_-th frame
    std::uint64_t stride_ = 1;
    std::array<double, phaseCount> phaseSeconds_{};
    std::uint64_t contacts_ = 0, collisions_ = 0, pairsTested_ = 0, missedPairs_ = 0, rebuilds_ = 0;
    std::uint64_t auditedFrames_ = 0;
};

}  // namespace quadrille::app
