#pragma once

#include <cstdint>
#include <string>

#include <quadrille/quadrille.hpp>

#include "app/options.hpp"

namespace quadrille::app {

/// A simulation that is ready to run, and where it came from.
struct Run {
    std::string scene;
    std::uint64_t seed;
    std::string requestedResolver;
    Simulation simulation;
};

/// A resolver that cannot run here, with --no-fallback; ends the program with exit code 4.
class NoDevice : public Error {
  public:
    using Error::Error;
};

/// Says on stderr that a device failed and what runs instead.
void warnOfFallback(const Simulation& simulation);

/// Loads the scene or the snapshot and makes the simulation that the options ask for. A resolver
/// that cannot run is replaced by the sequential one, with a warning on stderr.
Run setUp(const Options& options);

/// The report's policy misses pairs; how many is part of its result, and is counted.
bool mayMissPairs(const PartitionerConfig& partitioner);

}  // namespace quadrille::app
