#pragma once

#include <cstdint>

#include <quadrille/cuda_options.hpp>
#include <quadrille/partitioner_config.hpp>
#include <quadrille/vec2.hpp>

namespace quadrille {

/// How coordinates and velocities are stored and computed.
enum class Precision : std::uint8_t { Double, Float };

/// What a contact does to its two bodies; docs/step.md describes each law.
enum class Law : std::uint8_t { Baseline, Impulse, Continuous };

/// Who finds and resolves the contacts. Auto is the fastest that there is for the world's size; the
/// result is the same.
enum class ResolverKind : std::uint8_t { Auto, Sequential, Threads, Cuda, CudaResident };

/// What a scene says about its steps.
struct StepSettings {
    double dt = 1.0 / 60;    ///< s
    Vec2 gravity{0, 0};      ///< px/s^2
    double restitution = 1;  ///< in [0, 1]
};

/// Whether the resolver CudaResident does such steps of a law that runs on it on its device. Others
/// it leaves to the host, with the same result.
inline bool staysOnDevice(Law law, const StepSettings& step) {
    return law != Law::Continuous || (step.gravity == Vec2(0, 0) && step.restitution == 1);
}

struct SimulationConfig {
    PartitionerConfig partitioner = SemiStaticQuadtree{};
    /// The exact one; `impulse` is the choice where speed counts more (docs/accuracy.md).
    Law law = Law::Continuous;
    Precision precision = Precision::Double;
    ResolverKind resolver = ResolverKind::Sequential;
    int threads = 0;  ///< of Threads, and of the host beside a device; 0: one for each core
    StepSettings step{};
    bool keepContacts = false;      ///< for Simulation::contacts; listeners have them in any case
    bool profile = false;           ///< measure the phases of each step
    bool countMissedPairs = false;  ///< compare the broad phase with a complete one in each step
    /// With countMissedPairs: in the first step, and in about one of so many.
    std::uint64_t missedPairsEvery = 1;
    CudaOptions cuda{};
    /// A device that is missing or fails is replaced by the resolver `sequential`, which gives the
    /// same result; otherwise it is a DeviceError.
    bool fallback = false;
};

}  // namespace quadrille
