#include "app/progress.hpp"

#include <iostream>

#ifdef _WIN32
#include <io.h>
#define QUADRILLE_ISATTY(stream) (_isatty(_fileno(stream)) != 0)
#else
#include <unistd.h>
#define QUADRILLE_ISATTY(stream) (isatty(fileno(stream)) != 0)
#endif

namespace quadrille::app {

namespace {

constexpr const char* startOfLine = "\r\x1b[K";

}  // namespace

ProgressLine::ProgressLine(std::optional<std::uint64_t> frames)
    : frames_(frames), terminal_(QUADRILLE_ISATTY(stderr)) {}

void ProgressLine::show(std::uint64_t frame) const {
    if (!terminal_ || !frames_) return;
    std::cerr << startOfLine << "frame " << frame << " of " << *frames_ << std::flush;
}

void ProgressLine::show(std::uint64_t frame, double seconds) const {
    if (!terminal_) return;
    std::cerr << startOfLine << "frame " << frame;
    if (frames_) std::cerr << " of " << *frames_;
    std::cerr << ", and " << static_cast<std::uint64_t>(seconds) << " s in the next" << std::flush;
}

void ProgressLine::wipe() const {
    if (terminal_) std::cerr << startOfLine << std::flush;
}

}  // namespace quadrille::app
