#pragma once

#include <cstdint>

#include "statistics/gas.hpp"

/// What the statistics of the engine are held against (accuracy.md, sections 2 and 3). Each check
/// prints seed, sample and standard error, and comes in a short size for every run and a long one.
namespace quadrille::accuracy {

/// 1,024 squares between walls: F (Lx - S) / (N kT) = 1 + S K / N, from section 3.
struct GasState {
    double filling;
    double compressibility;
    double error;  ///< of the compressibility
};
inline constexpr GasState thin{0.006226, 1.01257, 1e-5};
inline constexpr GasState middling{0.05, 1.10825, 4e-5};
inline constexpr GasState thick{0.3, 2.00841, 30e-5};

struct Sample {
    double warmUp;  ///< s
    double time;    ///< s
};

/// Rate of pair hits and pressure on the walls agree with the state within four standard errors,
/// and the wall identity holds within `identity`.
void expectExactStatistics(const GasState& state, const GasConfig& config, const Sample& sample,
                           double identity);

/// The same figures of a law that is not exact: what its rate of pair hits is off by, relative to
/// the exact one, and what the wall identity is off by, relative to the sum of m v^2.
struct Bias {
    Estimate rate;
    double identity = 0;
};
Bias measureBias(const GasState& state, const GasConfig& config, const Sample& sample);

/// The sorted |vx| and |vy| of the scene `balanced` keep their bits for so many steps.
void expectSpeedsKeepTheirBits(Law law, Precision precision, std::uint64_t entities,
                               std::uint64_t steps);

}  // namespace quadrille::accuracy
