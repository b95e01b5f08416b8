#include "app/window/pacer.hpp"

#include <algorithm>
#include <cmath>

namespace quadrille::app {

namespace {

/// More than this between two pictures was a pause: a laptop's lid, a window that was dragged.
constexpr double longestPicture = 0.25;

}  // namespace

void Pacer::pass(double seconds) { owed_ += std::clamp(seconds, 0.0, longestPicture) * speed_; }

bool Pacer::take(int taken) {
    if (speed_ == 0) return taken == 0;
    // Pictures that come as often as steps should show one each, however their times jitter.
    if (owed_ < (taken == 0 ? 0.75 : 1) * dt_) return false;
    owed_ -= dt_;
    return true;
}

void Pacer::drop() { owed_ = std::min(owed_, std::fmod(std::max(owed_, 0.0), dt_)); }

}  // namespace quadrille::app
