#pragma once

#include <chrono>
#include <cstddef>
#include <ctime>
#include <ratio>
#include <vector>

namespace quadrille::bench {

/// Milliseconds per frame.
struct FrameTimes {
    double mean = 0, median = 0, p99 = 0;
};

/// `repeats` holds the milliseconds of each frame, once a repeat. A frame counts with its median
/// over the repeats: they do the same work, so that what differs is the machine's doing. What
/// varies between frames, a rebuilt tree say, stays. Throws Error if there are no values.
FrameTimes summarize(const std::vector<std::vector<double>>& repeats);

/// The time that the process has computed for: on a shared machine, that of what it does. Of one
/// thread only.
struct ProcessorClock {
    using duration = std::chrono::duration<double, std::ratio<1, CLOCKS_PER_SEC>>;
    using rep = duration::rep;
    using period = duration::period;
    using time_point = std::chrono::time_point<ProcessorClock>;
    static constexpr bool is_steady = true;
    static time_point now() { return time_point(duration(double(std::clock()))); }
};

/// Calls `step` that often and appends the milliseconds of each call to `milliseconds`.
template <class Clock = std::chrono::steady_clock, class Step>
void timeSteps(std::size_t count, std::vector<double>& milliseconds, Step&& step) {
    // One reading a step: the end of a step is the start of the next.
    auto start = Clock::now();
    for (std::size_t i = 0; i < count; ++i) {
        step();
        const auto end = Clock::now();
        milliseconds.push_back(std::chrono::duration<double, std::milli>(end - start).count());
        start = end;
    }
}

}  // namespace quadrille::bench
