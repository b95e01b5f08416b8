#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <quadrille/simulation.hpp>
#include <quadrille/world.hpp>

namespace quadrille {

/// Everything that decides how a run goes on, and where it came from.
struct Snapshot {
    std::string scene;
    std::uint64_t seed = 1;
    std::uint64_t stepsDone = 0;
    Law law = Law::Continuous;
    StepSettings step;
    World world;  ///< in the precision of the run
};

/// Writes the state of a simulation: entities with their generations, body columns, the built-in
/// components and names; not components of the user's own types. The file appears whole or not at
/// all. Throws Error if it cannot be written, or if `World::validate` finds fault.
void saveSnapshot(const std::filesystem::path& file, const Simulation& simulation,
                  const std::string& scene, std::uint64_t seed);

/// Reads a snapshot. Throws SnapshotError if it is damaged, not a snapshot of this version, or
/// holds a world or step settings that cannot be.
///
/// A run that goes on from it gives the same bits as one that was never interrupted, with any
/// complete partitioner and the laws `impulse` and `continuous`. `baseline` and the policy
/// EveryFrames also depend on the age of the tree, which starts anew.
Snapshot loadSnapshot(const std::filesystem::path& file);

}  // namespace quadrille
