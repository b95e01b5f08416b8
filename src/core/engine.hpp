#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <quadrille/cells.hpp>
#include <quadrille/config.hpp>
#include <quadrille/step_report.hpp>
#include <quadrille/vec2.hpp>

#include "collision/contact_record.hpp"
#include "core/body_store.hpp"

namespace quadrille {

/// The stretch of time that a step covers.
struct StepWindow {
    std::uint64_t number;  ///< of the step, from 1
    double from, to;       ///< s since the start of the run
    bool keepContacts;     ///< somebody will ask for them
    /// The law has begun the step. An engine that fails after that leaves it to another one to go
    /// on from here.
    bool begun = false;
};

/// Where a step runs, and with what.
class Engine {
  public:
    virtual ~Engine() = default;

    /// Advances the bodies by a step; fills the report's counts and, if the configuration asks for
    /// it, its times. Throws Error, and DeviceError with the bodies as the window says.
    virtual void step(BodyStore& store, StepWindow& window, StepReport& report) = 0;

    /// Of the last step; empty before the first.
    virtual const Cells& cells() const = 0;
    /// Of the last step, in the order of its law, if its window kept them.
    virtual std::span<const ContactRecord> contacts() = 0;

    virtual ResolverKind resolver() const = 0;
    /// Why the resolver that was asked for was replaced; empty if it was not.
    virtual const std::string& failure() const = 0;
    /// That share out the loops of a step.
    virtual unsigned threads() const = 0;
    /// Of work space.
    virtual std::size_t bytes() const = 0;
};

/// The engine for a configuration whose resolver is not Auto (engines/registry.cpp). Throws Error
/// for impossible values, NotAvailable for what this version cannot run and, unless the
/// configuration falls back, DeviceError if a device is missing.
std::unique_ptr<Engine> makeEngine(const SimulationConfig& config, const Vec2& worldSize);

/// The resolver that Auto stands for, for so many moving bodies (engines/choose_resolver.cpp).
ResolverKind chooseResolver(const SimulationConfig& config, std::size_t movingCount);

}  // namespace quadrille
