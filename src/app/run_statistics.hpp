#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <quadrille/simulation.hpp>

namespace quadrille::app {

struct FrameTimes {
    double mean = 0, median = 0, p99 = 0;  ///< ms
};

/// What showing a picture takes: building and drawing the panels; filling the buffers of bodies and
/// cells; drawing them; handing the picture to the screen.
enum class ShowPhase : std::uint8_t { Gui, Prepare, Draw, Present };
inline constexpr std::size_t showPhaseCount = 4;

/// The pictures that a window has shown.
struct Shown {
    int width = 0, height = 0;  ///< framebuffer pixels
    std::string renderer;       ///< the OpenGL driver's name for what draws
    std::uint64_t pictures = 0;
    std::array<double, showPhaseCount> seconds{};
};

/// Adds up what the steps of a run report. Memory stays bounded however long it runs.
class RunStatistics {
  public:
    void add(const StepReport& report, double milliseconds);

    /// Only where there is a window.
    std::optional<Shown> shown;

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
    std::uint64_t leftToHost() const { return leftToHost_; }  ///< frames

  private:
    static constexpr std::size_t mostSamples = std::size_t(1) << 22;

    std::uint64_t frames_ = 0;
    double totalMilliseconds_ = 0;
    std::vector<double> samples_;  // ms of every stride_-th frame
    std::uint64_t stride_ = 1;
    std::array<double, phaseCount> phaseSeconds_{};
    std::uint64_t contacts_ = 0, collisions_ = 0, pairsTested_ = 0, missedPairs_ = 0, rebuilds_ = 0;
    std::uint64_t auditedFrames_ = 0, leftToHost_ = 0;
};

}  // namespace quadrille::app
