#pragma once

#include <cstdint>

namespace quadrille::app {

/// The speeds that the window offers, in seconds of the simulation per second; 0 stands for a step
/// in every picture, as fast as they come.
inline constexpr double offeredSpeeds[] = {0.25, 0.5, 1, 2, 4, 8, 0};

/// Turns wall time into steps. A step is always dt long; what a slow machine cannot keep up with is
/// dropped, so that the simulation runs slower and never differently.
class Pacer {
  public:
    /// `dt` in s; `speed` as above, any number from 0.
    explicit Pacer(double dt, double speed) : dt_(dt), speed_(speed) {}

    double speed() const { return speed_; }
    void setSpeed(double speed) { speed_ = speed; }

    /// Wall time has passed, in s.
    void pass(double seconds);

    /// Whether a step is due, after `taken` of them in this picture; takes it off the account.
    bool take(int taken);

    /// Forgets the steps that are due: the time that the picture may take is used up.
    void drop();

  private:
    double dt_, speed_;
    double owed_ = 0;  // s of the simulation
};

}  // namespace quadrille::app
