#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scene_runs.hpp"

namespace quadrille::bench {

/// Every scene with every count, each with every partitioner, law and precision.
struct Sweep {
    std::vector<std::string> scenes;
    std::vector<std::uint64_t> entities;  ///< empty: the scene's own count
    std::vector<std::string> partitioners;
    std::vector<Law> laws{Law::Impulse};
    std::vector<Precision> precisions{Precision::Double};
    std::vector<std::string> resolvers{"sequential"};
    std::size_t frames = 200;
};

/// Reads `sequential`, `threads` (one for each core), `threads:N` or `cuda` into the variant.
/// Throws Error for anything else.
void parseResolver(std::string_view spec, Variant& variant);

/// All that parseResolver reads, for messages.
std::string resolverSpecs();

/// The spec of the resolver of a variant; parseResolver reads it back.
std::string resolverSpecOf(const Variant& variant);

std::vector<SceneRuns> expand(const Sweep& sweep);

/// The report's scaling experiment, with its parameters and its number of frames.
std::vector<Sweep> reportPreset();

/// The scenes that this project sets itself as targets.
std::vector<Sweep> targetsPreset();

/// What the threads are worth on this machine: 1, 2, 4 and so on up to its cores, against the
/// sequential resolver.
std::vector<Sweep> threadsPreset();

/// From how many bodies on each resolver of this machine is the fastest.
std::vector<Sweep> resolversPreset();

/// What a measurement is compared with.
struct Reference {
    std::string name;
    double milliseconds = 0;  ///< mean per frame
};

/// The report's own program on the same scene; none where it has no figure.
std::optional<Reference> reportReference(const Measurement& measurement);

/// The quadtree that is built anew each step, for a semi-static tree of the same parameters among
/// the runs of the same scene.
std::optional<Reference> rebuiltTree(const Measurement& measurement,
                                     const std::vector<Measurement>& sameScene);

/// The sequential resolver, for other ones among the runs of the same scene.
std::optional<Reference> sequentialResolver(const Measurement& measurement,
                                            const std::vector<Measurement>& sameScene);

/// Throws Error if runs of one scene that must end in the same state do not.
void requireOneState(const std::vector<Measurement>& sameScene);

}  // namespace quadrille::bench
