#pragma once

#include <cstdint>

namespace quadrille {

/// Bytes that this process may use at most: the memory of the machine, or less where a control
/// group or a resource limit says so; the largest number where nothing is known.
std::uint64_t memoryOfMachine();

}  // namespace quadrille
