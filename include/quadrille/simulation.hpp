#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <quadrille/bodies.hpp>
#include <quadrille/contact.hpp>
#include <quadrille/cuda_options.hpp>
#include <quadrille/partitioner.hpp>
#include <quadrille/vec2.hpp>
#include <quadrille/world.hpp>

namespace quadrille {

/// What a contact does to its two bodies; docs/step.md describes each law.
enum class Law : std::uint8_t { Baseline, Impulse, Continuous };

/// Who finds and resolves the contacts.
enum class ResolverKind : std::uint8_t { Sequential, Threads, Cuda, CudaResident };

std::string_view name(Law law);
std::string_view name(Precision precision);
std::string_view name(ResolverKind resolver);

/// What a scene says about its steps.
struct StepSettings {
    double dt = 1.0 / 60;    ///< s
    Vec2 gravity{0, 0};      ///< px/s^2
    double restitution = 1;  ///< in [0, 1]
};

struct SimulationConfig {
    PartitionerConfig partitioner = SemiStaticQuadtree{};
    Law law = Law::Impulse;
    Precision precision = Precision::Double;
    ResolverKind resolver = ResolverKind::Sequential;
    int threads = 0;                ///< of Threads, and of Cuda on the host; 0: one for each core
    double dt = 1.0 / 60;           ///< s
    Vec2 gravity{0, 0};             ///< px/s^2
    double restitution = 1;         ///< in [0, 1]
    bool profile = false;           ///< measure the phases of each step
    bool countMissedPairs = false;  ///< compare the broad phase with a complete one in each step
    /// With countMissedPairs: in the first step, and in about one of so many.
    std::uint64_t missedPairsEvery = 1;
    CudaOptions cuda{};
    /// A device that is missing or fails is replaced by the resolver `sequential`, which gives the
    /// same result; otherwise it is a DeviceError.
    bool fallback = false;
};

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
    std::uint64_t missedPairs = 0;  ///< only with SimulationConfig::countMissedPairs
    double auditSeconds = 0;        ///< what counting them took
    /// Pairs that a complete broad phase shows; counted if `audited`, as missedPairs are.
    std::uint64_t overlappingPairs = 0;
    bool audited = false;
    /// What listeners and observers took.
    double observeSeconds = 0;
    std::array<double, phaseCount> phaseSeconds{};  ///< only with SimulationConfig::profile
};

/// What the scene makes the engine model; what is absent costs nothing.
struct ModelFeatures {
    bool movingBodies = false;
    bool staticBodies = false;
    bool gravity = false;
    bool inelastic = false;     ///< restitution below 1
    bool sizesDiffer = false;   ///< moving bodies have their own sizes
    bool massesDiffer = false;  ///< moving bodies have their own masses
    bool listeners = false;     ///< contacts are handed out
    bool profile = false;       ///< phases are timed
};

/// Advances a world in steps of equal length.
///
/// The result of a step depends on the world, law, precision, dt, gravity and restitution; never on
/// the partitioner (BruteForce and SemiStaticQuadtree::EveryFrames apart, which is allowed to miss
/// pairs), the clock or the number of steps asked for at once.
class Simulation {
  public:
    /// Throws Error for impossible values, NotAvailable for combinations that this version cannot
    /// run and, without SimulationConfig::fallback, DeviceError if a device is missing.
    explicit Simulation(World world, SimulationConfig config = {});
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    /// One step. Throws Error if a position stops being finite and, without
    /// SimulationConfig::fallback, DeviceError if a device fails.
    const StepReport& step();
    void run(std::uint64_t steps);

    World& world();
    const World& world() const;
    /// What runs now: after a fallback, with the resolver `sequential`.
    const SimulationConfig& config() const;
    /// Why another resolver was replaced by `sequential`; empty if none was.
    const std::string& resolverFailure() const;

    std::uint64_t stepsDone() const;
    double time() const;  ///< s, stepsDone * dt

    /// Called in canonical order for every contact, after all of a step's contacts are resolved.
    void onContact(std::function<void(const Contact&)> listener);
    /// Called after every step.
    void onStep(std::function<void(const World&, const StepReport&)> observer);
    /// Called before every step, in the order in which they were added.
    void addSystem(std::function<void(World&, double dt)> system);

    /// Takes effect with the next step; the state stays as it is.
    void setPartitioner(const PartitionerConfig& partitioner);

    /// The same for everything that a step is made with: law, resolver, gravity, what is measured.
    /// Throws what the constructor throws, and Error if dt or precision would change, since the
    /// time and the state are kept in them; then nothing changes.
    void reconfigure(const SimulationConfig& config);

    /// The cells of the last step; empty before the first.
    const Cells& cells() const;

    /// Threads that a step may use.
    int threads() const;
    /// Cores that this process may use: what SimulationConfig::threads = 0 stands for.
    static int cores();

    ModelFeatures features() const;

    /// Bytes that the simulation allocated beside the world: cells, contacts, work space.
    std::size_t workspaceBytes() const;

    /// Continues the count of steps from a snapshot.
    void resumeAt(std::uint64_t stepsDone);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace quadrille
