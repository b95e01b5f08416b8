#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace quadrille::app {

/// How far a run has got, on a terminal, wiped when done; nothing if stderr is none.
class ProgressLine {
  public:
    /// Without a number of frames or a duration (wall s), only long frames are shown.
    ProgressLine(std::optional<std::uint64_t> frames, std::optional<double> duration);

    /// `elapsed` is the wall time since the start of the run, in s.
    void show(std::uint64_t frame, double elapsed) const;
    /// The same from inside the frame after that, which has lasted for so many seconds.
    void show(std::uint64_t frame, double elapsed, double inFrame) const;
    void wipe() const;

    /// "frame 120 of 600, 20 %, 3 min 20 s left", as far as that is known. Of a number of frames
    /// and a duration, what ends the run first counts.
    std::string text(std::uint64_t frame, double elapsed) const;

  private:
    std::optional<std::uint64_t> frames_;
    std::optional<double> duration_;
    bool terminal_;
};

}  // namespace quadrille::app
