#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/partitioner_config.hpp>
#include <quadrille/scene.hpp>
#include <quadrille/simulation.hpp>

#include "bench/statistics.hpp"

namespace quadrille::bench {

/// How a scene is run; a row of the table.
struct Variant {
    PartitionerConfig partitioner;
    Law law = Law::Impulse;
    Precision precision = Precision::Double;
    ResolverKind resolver = ResolverKind::Sequential;
    int threads = 0;  ///< 0: one for each core
    CudaOptions cuda{};
    bool profile = false;
    std::string label{};                   ///< what `change` makes of the scene
    std::function<void(Scene&)> change{};  ///< applied to the scene before it runs
    bool listener = false;                 ///< somebody listens to contacts
};

/// A scene and the variants that are compared on it.
struct SceneRuns {
    std::string scene;                      ///< name or file
    std::optional<std::uint64_t> entities;  ///< replaces the count of the first spawn group
    std::vector<Variant> variants;
    std::size_t frames = 200;
    std::optional<double> dt{};  ///< s; the scene's
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
