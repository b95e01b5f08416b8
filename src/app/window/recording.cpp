#include "app/window/recording.hpp"

#include <filesystem>
#include <iostream>
#include <system_error>

#include <quadrille/error.hpp>

#include "app/window/text.hpp"

namespace quadrille::app {

namespace {

constexpr double lineSeconds = 0.2;

double secondsBetween(std::chrono::steady_clock::time_point from,
                      std::chrono::steady_clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

}  // namespace

Recording::Recording(const Options& options, const SdlWindow::Size& size)
    : options_(options),
      film_(options.window.video, size.pixelWidth, size.pixelHeight, options.window.frameRate),
      line_(options.frames, options.duration),
      lastLine_(Clock::now()),
      lastReport_(lastLine_) {
    std::cerr << options.window.video << ": " << size.pixelWidth << " x " << size.pixelHeight
              << " at " << options.window.frameRate << " pictures per second, " << film_.format()
              << '\n';
}

void Recording::add(const RunSession& session, const SdlWindow::Size& size) {
    film_.add(readFramebuffer(size.pixelWidth, size.pixelHeight));
    const auto now = Clock::now();
    const std::uint64_t frames = session.statistics().frames();
    if (secondsBetween(lastLine_, now) >= lineSeconds) {
        line_.show(frames, session.elapsed());
        lastLine_ = now;
    }
    if (secondsBetween(lastReport_, now) >= options_.reportEvery) {
        line_.wipe();
        std::cerr << options_.window.video << ": " << grouped(std::uint64_t(film_.pictures()))
                  << " pictures, " << line_.text(frames, session.elapsed()) << '\n';
        lastReport_ = now;
    }
}

void Recording::commit() {
    line_.wipe();
    if (film_.pictures() == 0) {
        throw Error(options_.window.video + ": no picture was taken, since the run stood still");
    }
    film_.commit();
    std::error_code error;
    const auto bytes = std::filesystem::file_size(options_.window.video, error);
    std::cerr << options_.window.video << ": " << grouped(std::uint64_t(film_.pictures()))
              << " pictures, "
              << formatted("%.1f s", double(film_.pictures()) / options_.window.frameRate);
    if (!error) std::cerr << ", " << formatted("%.1f MB", double(bytes) / 1e6);
    std::cerr << '\n';
}

}  // namespace quadrille::app
