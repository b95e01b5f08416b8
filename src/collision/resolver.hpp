#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/simulation.hpp>

#include "collision/broad/partitioner.hpp"
#include "collision/rules/step_parameters.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// A contact as the resolvers hand it to observers.
struct ContactRecord {
    double time;      ///< of the impact, s since the start of the run
    std::uint32_t a;  ///< row of a moving body
    std::int64_t b;   ///< row of a moving body, or -1 - row of a static one
    std::uint8_t axes;
    std::int8_t senseX, senseY;
    bool collided;
};

struct ResolveCounts {
    std::uint64_t contacts = 0;
    std::uint64_t collisions = 0;
    std::uint64_t pairsTested = 0;
};

class PhaseClock;

/// Executes narrow phase and contact law for one step.
template <class Real>
class Resolver {
  public:
    virtual ~Resolver() = default;

    /// Called in each step when the bodies have been integrated and before `resolve`, so that a
    /// resolver that keeps a state of its own can bring it up to date. `clock` lives until the step
    /// ends. Throws DeviceError.
    virtual void integrated(const BodyView<Real>& /*bodies*/, const StepParameters<Real>& /*step*/,
                            PhaseClock& /*clock*/) {}

    /// Changes positions and velocities of the moving bodies. Appends to `records`, unless it is
    /// null, one record for each contact in the order in which they are resolved. Throws
    /// DeviceError, and has then changed nothing.
    virtual ResolveCounts resolve(const BodyView<Real>& bodies, const Partition<Real>& partition,
                                  const StepParameters<Real>& step,
                                  std::vector<ContactRecord>* records) = 0;

    /// Bytes of work space.
    virtual std::size_t bytes() const = 0;
};

/// The resolver of a discrete law; `team` must outlive it. Throws NotAvailable if this version has
/// none of that kind, and DeviceError if it needs a device that is not there.
template <class Real>
std::unique_ptr<Resolver<Real>> makeResolver(const SimulationConfig& config,
                                             const ThreadTeam& team);

}  // namespace quadrille
