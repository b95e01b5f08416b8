#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace quadrille {

/// The phases of a step, in the order in which they run. Those between Partition and Observe, but
/// for Resolve, take time only where a device resolves.
enum class Phase : std::uint8_t {
    Integrate,
    Partition,
    Flatten,       ///< what the device needs is gathered
    CopyToDevice,  ///< and copied there
    Resolve,
    CopyToHost,
    Observe,
};
inline constexpr std::size_t phaseCount = 7;

struct StepReport {
    std::uint64_t step = 0;         ///< number of the step that ended, from 1
    std::uint64_t contacts = 0;     ///< pairs that touched
    std::uint64_t collisions = 0;   ///< contacts that exchanged an impulse
    std::uint64_t pairsTested = 0;  ///< pairs whose boxes were compared
    bool rebuilt = false;           ///< the partition was built in this step
    bool leftToHost = false;        ///< the device left the step, or the rest of it, to the host
    std::uint64_t missedPairs = 0;  ///< only with SimulationConfig::countMissedPairs
    double auditSeconds = 0;        ///< what counting them took
    /// Pairs that a complete broad phase shows; counted if `audited`, as missedPairs are.
    std::uint64_t overlappingPairs = 0;
    bool audited = false;
    /// What listeners and observers took.
    double observeSeconds = 0;
    std::array<double, phaseCount> phaseSeconds{};  ///< only with SimulationConfig::profile
};

}  // namespace quadrille
