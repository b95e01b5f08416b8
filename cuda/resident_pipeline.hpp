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

    /// Whether the law, with its settings, runs here at all; else every step is the host's.
    virtual bool runs() const { return true; }
    /// The columns of state that the law keeps in the BodyStore.
    virtual KeptColumns kept() const { return {}; }

    /// Takes over the bodies of the host as they are at a time, s. Returns whether it could: a law
    /// that keeps anchors takes bodies only where these say that they are. Throws DeviceError.
    virtual bool load(const LawBodies<Real>& bodies, double now, PhaseClock& clock) = 0;

    /// Advances the bodies that were loaded by a step. Returns the time up to which it has done so,
    /// s: the end of the step, or an earlier one from which on the host has to go on. Throws Error
    /// if a position stops being finite, and DeviceError, after which the bodies here are no longer
    /// known.
    virtual double step(Step<Real>& step) = 0;

    /// Writes the bodies, as they are at the time up to which steps were done, to the rows that
    /// were loaded. Throws DeviceError, and has then written nothing.
    virtual void fetch(const LawBodies<Real>& bodies) = 0;

    /// Of the last partition. Throws DeviceError.
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

/// The same for the law `continuous`, which runs there without gravity and with restitution 1.
template <class Real>
std::unique_ptr<ResidentPipeline<Real>> makeResidentContinuous(const SimulationConfig& config,
                                                               const Vec2& worldSize,
                                                               const ThreadTeam& team);

}  // namespace quadrille
