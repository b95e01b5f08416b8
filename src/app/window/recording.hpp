#pragma once

#include <chrono>
#include <string>

#include "app/options.hpp"
#include "app/run_session.hpp"
#include "app/window/film.hpp"
#include "app/window/sdl_window.hpp"

namespace quadrille::app {

/// The film of --video, and what is said of it on stderr: how it is written, how far it has got,
/// and what has become of it.
class Recording {
  public:
    /// Throws Error if the file cannot be written.
    Recording(const Options& options, const SdlWindow::Size& size);

    /// How far the simulation is to go on for the next picture, s of the film.
    double secondsSinceLast() const {
        return film_.pictures() == 0 ? 0 : 1.0 / options_.window.frameRate;
    }

    /// The picture that was drawn and not yet presented.
    void add(const RunSession& session, const SdlWindow::Size& size);

    /// Throws Error if anything could not be written.
    void commit();

  private:
    using Clock = std::chrono::steady_clock;

    const Options& options_;
    Film film_;
    ProgressLine line_;
    Clock::time_point lastLine_, lastReport_;
};

}  // namespace quadrille::app
