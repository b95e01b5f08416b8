#include "app/window/comparison_history.hpp"

namespace quadrille::app {

void ComparisonHistory::add(const ComparedFrame& frame) {
    // Frames in which cells are built anew cost many times those between them.
    constexpr double weight = 1.0 / 16;
    for (std::size_t run = 0; run < 2; ++run) {
        const double now = frame.milliseconds[run];
        cost_[run] = since_ == 0 ? now : cost_[run] + weight * (now - cost_[run]);
    }
    if (since_++ % stride_ != 0) return;
    if (points_.size() == most) {
        for (std::size_t i = 0; i < most / 2; ++i) points_[i] = points_[2 * i];
        points_.resize(most / 2);
        stride_ *= 2;
    }
    const accuracy::Divergence& d = frame.divergence;
    points_.push_back({.time = d.time,
                       .bodies = {double(d.apart), double(d.wrongBodies)},
                       .collisions = {double(d.events.missed()), double(d.events.invented())},
                       .overlap = d.overlapMax,
                       .cost = cost_});
}

}  // namespace quadrille::app
