#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/partitioner.hpp>
#include <quadrille/simulation.hpp>

#include "bench/statistics.hpp"

namespace quadrille::bench {

/// How a scene is run; a row of the table.
struct Variant {
    PartitionerConfig partitioner;
    Law law = Law::Impulse;
    Precision precision = Precision::Double;
    ResolverKind resolver = ResolverKind::Sequential;
    CudaOptions cuda{};
    bool profile = false;
};

/// A scene and the variants that are compared on it.
struct SceneRuns {
    std::string scene;                      ///< name or file
    std::optional<std::uint64_t> entities;  ///< replaces the count of the first spawn group
    std::vector<Variant> variants;
    std::size_t frames = 200;
};

/// What all scenes of a run share.
struct Protocol {
    std::size_t warmup = 20;
    std::size_t repeats = 3;
};

struct Measurement {
    Variant variant;
    std::string scene;
    std::size_t bodies = 0;  ///< that move
    FrameTimes times;
    std::array<double, phaseCount> phaseMilliseconds{};  ///< mean a frame; only with a profile
    double pairsPerBody = 0;
    double contactsPerFrame = 0;
    double rebuildsPer100 = 0;
    std::optional<double> energyDrift;  ///< relative; none where energy is not conserved
    double bytesPerBody = 0;
    CellLoad cells;  ///< of the last frame
    std::uint64_t stateHash = 0;

    double nsPerBody(double milliseconds) const { return 1e6 * milliseconds / double(bodies); }
};

/// Runs every variant as often as the protocol says. The variants take turns, so that a drift of
/// the machine's speed meets all of them. Variants that this version cannot run are left out, and
/// said to be on stderr. Throws Error if two repeats of a variant differ in their result.
std::vector<Measurement> measure(const SceneRuns& runs, const Protocol& protocol);

}  // namespace quadrille::bench
