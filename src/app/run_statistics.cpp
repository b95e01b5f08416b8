#include "app/run_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace quadrille::app {

void RunStatistics::add(const StepReport& report, double milliseconds) {
    if (frames_ % stride_ == 0) {
        if (samples_.size() == mostSamples) {
            // Keep every second sample, and take half as many from here on.
            for (std::size_t i = 0; i < mostSamples / 2; ++i) samples_[i] = samples_[2 * i];
            samples_.resize(mostSamples / 2);
            stride_ *= 2;
        }
        if (frames_ % stride_ == 0) samples_.push_back(milliseconds);
    }
    ++frames_;
    totalMilliseconds_ += milliseconds;
    for (std::size_t i = 0; i < phaseCount; ++i) phaseSeconds_[i] += report.phaseSeconds[i];
    contacts_ += report.contacts;
    collisions_ += report.collisions;
    pairsTested_ += report.pairsTested;
    missedPairs_ += report.missedPairs;
    auditedFrames_ += report.audited;
    rebuilds_ += report.rebuilt;
    leftToHost_ += report.leftToHost;
}

FrameTimes RunStatistics::times() const {
    if (frames_ == 0) return {};
    std::vector<double> sorted = samples_;
    std::sort(sorted.begin(), sorted.end());
    const auto quantile = [&](double q) {
        return sorted[static_cast<std::size_t>(std::lround(q * double(sorted.size() - 1)))];
    };
    return {.mean = totalMilliseconds_ / double(frames_),
            .median = quantile(0.5),
            .p99 = quantile(0.99)};
}

std::array<double, phaseCount> RunStatistics::phaseMilliseconds() const {
    std::array<double, phaseCount> result{};
    if (frames_ == 0) return result;
    for (std::size_t i = 0; i < phaseCount; ++i) {
        result[i] = 1e3 * phaseSeconds_[i] / double(frames_);
    }
    return result;
}

}  // namespace quadrille::app
