#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include <quadrille/simulation.hpp>

namespace quadrille {

/// Makes a new world, the same each time.
using MakeWorld = std::function<World()>;
/// Changes a world before a step.
using Edit = std::function<void(World&, std::uint64_t step)>;

/// Expects the same contacts in the same order, to the last bit of what they exchanged.
void expectSameContacts(std::span<const Contact> found, std::span<const Contact> expected);

/// Runs a resolver of the device (`cuda` unless the configuration names another) and `sequential`
/// side by side, both keeping contacts, and expects the
/// same state, the same counts and the same contacts in the same order after every step; and the
/// same state from the device without contacts kept. Returns the number of contacts.
std::uint64_t expectLockstep(const MakeWorld& makeWorld, const SimulationConfig& config,
                             std::uint64_t steps, const Edit& edit = {});

}  // namespace quadrille
