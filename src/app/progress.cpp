#include "app/progress.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

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

/// Beyond this, nobody waits for the end, and the estimate says little.
constexpr double longestForecast = 1000 * 86400.0;

/// In the two largest units: "3 min 20 s".
std::string inWords(double time) {
    const auto seconds = static_cast<std::uint64_t>(std::ceil(time));
    const auto two = [](std::uint64_t large, const char* unit, std::uint64_t small,
                        const char* smallUnit) {
        return std::to_string(large) + unit + std::to_string(small) + smallUnit;
    };
    if (seconds < 60) return std::to_string(seconds) + " s";
    if (seconds < 3600) return two(seconds / 60, " min ", seconds % 60, " s");
    if (seconds < 86400) return two(seconds / 3600, " h ", seconds / 60 % 60, " min");
    return two(seconds / 86400, " d ", seconds / 3600 % 24, " h");
}

}  // namespace

ProgressLine::ProgressLine(std::optional<std::uint64_t> frames, std::optional<double> duration)
    : frames_(frames), duration_(duration), terminal_(QUADRILLE_ISATTY(stderr)) {}

void ProgressLine::show(std::uint64_t frame, double elapsed) const {
    if (!terminal_ || !(frames_ || duration_)) return;
    std::cerr << startOfLine << text(frame, elapsed) << std::flush;
}

void ProgressLine::show(std::uint64_t frame, double elapsed, double inFrame) const {
    if (!terminal_) return;
    std::cerr << startOfLine << text(frame, elapsed) << ", and "
              << static_cast<std::uint64_t>(inFrame) << " s in the next" << std::flush;
}

void ProgressLine::wipe() const {
    if (terminal_) std::cerr << startOfLine << std::flush;
}

std::string ProgressLine::text(std::uint64_t frame, double elapsed) const {
    std::string line = "frame " + std::to_string(frame);
    double percent = 0;
    double left = std::numeric_limits<double>::infinity();
    if (frames_) {
        line += " of " + std::to_string(*frames_);
        percent = 100 * double(frame) / double(*frames_);
        // The frames to come are taken to last as long as those so far.
        if (frame > 0) left = elapsed * (double(*frames_) - double(frame)) / double(frame);
    }
    if (duration_) {
        percent = std::max(percent, std::min(100 * elapsed / *duration_, 100.0));
        left = std::min(left, std::max(*duration_ - elapsed, 0.0));
    }
    if (!frames_ && !duration_) return line;
    line += ", " + std::to_string(static_cast<int>(percent)) + " %";
    if (left <= longestForecast) line += ", " + inWords(left) + " left";
    return line;
}

}  // namespace quadrille::app
