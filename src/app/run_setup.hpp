#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <quadrille/quadrille.hpp>

#include "app/options.hpp"

namespace quadrille::app {

/// A simulation that is ready to run, and where it came from.
struct Run {
    std::string scene;
    std::uint64_t seed;
    ResolverKind requestedResolver;
    Simulation simulation;
    bool lawNamed = false;                      ///< by the scene or the snapshot
    std::optional<std::uint64_t> spawned = {};  ///< count of the scene's first spawn group
    std::unique_ptr<Run> beside = nullptr;      ///< what it is compared with
};

/// Says on stderr that a device failed and what runs instead.
void warnOfFallback(const Run& run);

/// Loads the scene or the snapshot and makes the simulation that the options ask for, and the one
/// beside it. A resolver that cannot run is replaced by the sequential one, with a warning on
/// stderr.
Run setUp(const Options& options);

/// The report's policy misses pairs; how many is part of its result, and is counted.
bool mayMissPairs(const PartitionerConfig& partitioner);

}  // namespace quadrille::app
