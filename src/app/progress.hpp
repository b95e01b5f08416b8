#pragma once

#include <cstdint>
#include <optional>

namespace quadrille::app {

/// "frame 120 of 600" on a terminal, wiped when done; nothing if stderr is none.
class ProgressLine {
  public:
    /// Without a number of frames, only long frames are shown.
    explicit ProgressLine(std::optional<std::uint64_t> frames);

    void show(std::uint64_t frame) const;
    /// The same from inside the frame after that, which has lasted for so many seconds.
    void show(std::uint64_t frame, double seconds) const;
    void wipe() const;

  private:
    std::optional<std::uint64_t> frames_;
    bool terminal_;
};

}  // namespace quadrille::app
