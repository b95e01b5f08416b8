#include "app/window/error_history.hpp"

#include <utility>

#include <quadrille/error.hpp>

namespace quadrille::app {

namespace {

constexpr int share = 20;  // of the time, one part
constexpr std::chrono::milliseconds leastInterval{100};

}  // namespace

void ErrorHistory::update(const Workbench& bench) {
    const RunSession& session = bench.session();
    if (!session.measuresError()) return;
    if (runVersion_ != bench.runVersion()) {
        *this = {};
        runVersion_ = bench.runVersion();
    }
    const std::uint64_t steps = session.statistics().frames();
    const auto before = Clock::now();
    if (!failure_.empty() || steps == steps_ || (before < due_ && !bench.paused())) return;
    steps_ = steps;
    try {
        last_ = session.errorSoFar();
    } catch (const Error& error) {
        failure_ = error.what();
        return;
    }
    add({bench.simulation().time(), last_->events.recall(), last_->events.precision(),
         last_->wrongBodyFraction()});
    const auto after = Clock::now();
    seconds_ += std::chrono::duration<double>(after - before).count();
    due_ = after + std::max<Clock::duration>(leastInterval, share * (after - before));
}

/// Once there are too many, every second one goes, and half as many come.
void ErrorHistory::add(const Sample& sample) {
    if (++skipped_ < every_) return;
    skipped_ = 0;
    samples_.push_back(sample);
    if (samples_.size() < mostSamples) return;
    for (std::size_t i = 0; 2 * i + 1 < samples_.size(); ++i) samples_[i] = samples_[2 * i + 1];
    samples_.resize(samples_.size() / 2);
    every_ *= 2;
}

double ErrorHistory::takeSeconds() { return std::exchange(seconds_, 0); }

}  // namespace quadrille::app
