#include "bench/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <quadrille/error.hpp>

namespace quadrille::bench {

namespace {

double middle(const std::vector<double>& sorted) {
    if (sorted.empty()) throw Error("statistics: nothing was measured");
    const std::size_t half = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

}  // namespace

FrameTimes summarize(const std::vector<std::vector<double>>& repeats) {
    std::vector<double> frames, ofFrame(repeats.size());
    for (std::size_t i = 0; !repeats.empty() && i < repeats.front().size(); ++i) {
        std::ranges::transform(repeats, ofFrame.begin(), [&](const auto& r) { return r.at(i); });
        std::sort(ofFrame.begin(), ofFrame.end());
        frames.push_back(middle(ofFrame));
    }
    std::sort(frames.begin(), frames.end());
    FrameTimes times;
    times.median = middle(frames);
    const double count = double(frames.size());
    times.mean = std::accumulate(frames.begin(), frames.end(), 0.0) / count;
    // Nearest rank: the smallest value that 99 % of the frames do not exceed.
    times.p99 = frames[static_cast<std::size_t>(std::ceil(0.99 * count)) - 1];
    return times;
}

}  // namespace quadrille::bench
