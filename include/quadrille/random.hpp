#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace quadrille {

/// Random numbers that are the same on every platform: the standard fixes the generator's output,
/// but not that of its distributions, so those are made here.
class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// Uniform in [low, high), in steps of 2^-53 of the range.
    double uniform(double low, double high) {
        const double value = low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
        return value < high ? value : std::nextafter(high, low);  // the sum may round up to high
    }

    /// Uniform integer in [low, high], by rejection.
    std::int64_t integer(std::int64_t low, std::int64_t high) {
        const auto range = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low) + 1;
        if (range == 0) return static_cast<std::int64_t>(engine_());
        const std::uint64_t reject = (0 - range) % range;
        std::uint64_t bits = engine_();
        while (bits < reject) bits = engine_();
        return static_cast<std::int64_t>(static_cast<std::uint64_t>(low) + bits % range);
    }

    /// -1 or +1.
    double sign() { return (engine_() >> 63) != 0 ? -1.0 : 1.0; }

    std::mt19937_64& engine() { return engine_; }
    const std::mt19937_64& engine() const { return engine_; }

  private:
    std::mt19937_64 engine_;
};

}  // namespace quadrille
