#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include <quadrille/bodies.hpp>
#include <quadrille/cells.hpp>
#include <quadrille/config.hpp>
#include <quadrille/vec2.hpp>

#include "collision/contact_record.hpp"
#include "collision/law.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// The steps of a law on a device that keeps the bodies: it makes the cells, finds the pairs and
/// resolves their contacts there. The host has what it asks for.
template <class Real>
class ResidentPipeline {
  public:
    virtual ~ResidentPipeline() = default;

    /// Takes over the bodies of the host as they are. Throws DeviceError.
    virtual void load(const BodyView<Real>& bodies, PhaseClock& clock) = 0;

    /// Advances the bodies that were loaded by a step. Throws Error if a position stops being
    /// finite, and DeviceError, after which the bodies here are no longer known.
    virtual void step(Step<Real>& step) = 0;

    /// Writes positions and velocities to the rows that were loaded. Throws DeviceError, and has
    /// then written nothing.
    virtual void fetch(const MutableBodyView<Real>& bodies) = 0;

    /// Of the last step. Throws DeviceError.
    virtual const Cells& cells() = 0;
    /// Of the last step, if it was to keep them.
    virtual std::span<const ContactRecord> contacts() = 0;

    /// Of work space, on the device and page-locked.
    virtual std::size_t bytes() const = 0;
};

/// The law `impulse` on a CUDA device, from the folder cuda/, or a stand-in in builds without it.
/// Its cells are those of the StaticGrid that the configuration names, and with another partitioner
/// of a grid that fits the bodies. `team` does the host's part and must outlive it. Throws
/// DeviceError if there is no device.
template <class Real>
std::unique_ptr<ResidentPipeline<Real>> makeResidentImpulse(const SimulationConfig& config,
                                                            const Vec2& worldSize,
                                                            const ThreadTeam& team);

}  // namespace quadrille
