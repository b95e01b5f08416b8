#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include <quadrille/cells.hpp>
#include <quadrille/config.hpp>
#include <quadrille/contact.hpp>
#include <quadrille/step_report.hpp>
#include <quadrille/world.hpp>

namespace quadrille {

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

/// What was registered with a Simulation; lets it be taken out again. May be thrown away: what was
/// registered then stays for good.
class Subscription {
  public:
    Subscription() = default;
    explicit Subscription(std::shared_ptr<bool> active) : active_(std::move(active)) {}

    /// No more calls from here on, even if made inside a call. Does nothing the second time.
    void remove() {
        if (active_) *active_ = false;
    }
    bool active() const { return active_ && *active_; }

  private:
    std::shared_ptr<bool> active_;
};

struct Snapshot;

/// Advances a world in steps of equal length.
///
/// The result of a step depends on the world, law, precision, dt, gravity and restitution; never on
/// the partitioner (SemiStaticQuadtree::EveryFrames apart, which is allowed to miss pairs), the
/// resolver, the clock or the number of steps asked for at once.
class Simulation {
  public:
    /// Throws Error for impossible values, NotAvailable for combinations that this version cannot
    /// run and, without SimulationConfig::fallback, DeviceError if a device is missing.
    explicit Simulation(World world, const SimulationConfig& config = {});
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;
    Simulation(const Simulation&) = delete;  ///< to go back or branch off, see `snapshot`
    Simulation& operator=(const Simulation&) = delete;

    /// One step. Throws Error if a position stops being finite, or if it is called inside a step,
    /// by a system or listener; and, without SimulationConfig::fallback, DeviceError if a device
    /// fails.
    const StepReport& step();
    void run(std::uint64_t steps);

    World& world();
    const World& world() const;
    /// What runs now: with the resolver that Auto stands for, and after a fallback with
    /// `sequential`.
    const SimulationConfig& config() const;
    /// Why another resolver was replaced by `sequential`; empty if none was.
    const std::string& resolverFailure() const;

    std::uint64_t stepsDone() const;
    double time() const;  ///< s, stepsDone * dt

    // ---- what happened in the last step

    /// Its contacts in canonical order, or of `baseline` in that of the cells; kept if, at its
    /// start, SimulationConfig::keepContacts said so or a contact listener was registered, and
    /// valid until the next step. Throws Error if they were not kept.
    std::span<const Contact> contacts() const;
    /// Its cells; empty before the first.
    const Cells& cells() const;

    /// Called for every contact, in the order of `contacts`, after all of a step's are resolved.
    Subscription onContact(std::function<void(const Contact&)> listener);
    /// Called after every step.
    Subscription onStep(std::function<void(const World&, const StepReport&)> observer);
    /// Called before every step, in the order in which they were added.
    Subscription addSystem(std::function<void(World&, double dt)> system);

    // ---- other ways to go on

    /// Takes effect with the next step; the state stays as it is.
    void setPartitioner(const PartitionerConfig& partitioner);

    /// The same for everything that a step is made with: law, resolver, gravity, what is measured.
    /// Throws what the constructor throws, and Error if dt or precision would change, since the
    /// time and the state are kept in them; then nothing changes.
    void reconfigure(const SimulationConfig& config);

    /// The state with everything that decides how the run goes on: world, law, step settings and
    /// the number of steps done. A copy, so that this one may go on.
    Snapshot snapshot() const;

    /// Goes on from there, bit for bit as the run did that the snapshot is of, with the
    /// partitioner, resolver and listeners of this simulation. Throws NotAvailable if they cannot
    /// run its law, DeviceError if a device is missing, and Error inside a step; then nothing
    /// changes.
    void restore(const Snapshot& snapshot);

    // ---- about the run

    /// Threads that a step may use.
    int threads() const;
    /// Cores that this process may use: what SimulationConfig::threads = 0 stands for.
    static int cores();

    ModelFeatures features() const;

    /// Bytes that the simulation allocated beside the world: cells, contacts, work space.
    std::size_t workspaceBytes() const;

    /// Continues the count of steps from a snapshot. Throws Error beyond 2^53.
    void resumeAt(std::uint64_t stepsDone);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace quadrille
