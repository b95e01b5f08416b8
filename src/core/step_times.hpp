#pragma once

#include <cmath>
#include <cstdint>

namespace quadrille {

/// When steps end. A sum of rounded steps would drift, and a product of the step and its number
/// would give one moment different bits for different steps; where a whole number of steps makes a
/// second, the number of the step is divided instead, so that runs with any such dt agree about
/// every moment that they share.
class StepTimes {
  public:
    /// Beyond it, a double does not tell one number from the next.
    static constexpr std::uint64_t mostSteps = std::uint64_t{1} << 53;

    explicit StepTimes(double dt) : dt_(dt) {
        const double perSecond = std::round(1 / dt);
        if (perSecond >= 1 && perSecond < 0x1p52 && 1 / perSecond == dt) perSecond_ = perSecond;
    }

    /// The end of step `number`, s from the start of the run.
    double at(std::uint64_t number) const {
        const auto n = static_cast<double>(number);
        return perSecond_ > 0 ? n / perSecond_ : n * dt_;
    }

  private:
    double dt_;
    double perSecond_ = 0;
};

}  // namespace quadrille
