#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/metrics.hpp"
#include "app/window/workbench.hpp"

namespace quadrille::app {

/// What --error has measured over the run so far. It is looked at as often as that takes a
/// twentieth of the time; memory stays bounded.
class ErrorHistory {
  public:
    struct Sample {
        double time;         ///< s, of the simulation
        double found;        ///< share of the exact collisions that the run has
        double real;         ///< share of the run's collisions that the exact one has
        double wrongBodies;  ///< share of the bodies whose velocity is not the exact one
    };

    void update(const Workbench& bench);

    const std::vector<Sample>& samples() const { return samples_; }
    /// Of the last look.
    const std::optional<accuracy::ErrorMetrics>& last() const { return last_; }
    /// Why there are no more; empty while there are.
    const std::string& failure() const { return failure_; }

    /// What looking took since the last call, s.
    double takeSeconds();

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::size_t mostSamples = 256;

    void add(const Sample& sample);

    std::vector<Sample> samples_;
    std::size_t every_ = 1, skipped_ = 0;  // looks that become a sample
    std::optional<accuracy::ErrorMetrics> last_;
    std::string failure_;
    Clock::time_point due_;
    double seconds_ = 0;
    std::uint64_t runVersion_ = 0, steps_ = 0;
};

}  // namespace quadrille::app
