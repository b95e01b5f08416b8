#pragma once

#include <cstddef>
#include <optional>

namespace quadrille::bench {

/// Bytes of the process that are in memory now; none where the platform does not say.
std::optional<std::size_t> residentBytes();

/// Hands freed memory back to the system where that is possible, so that what is allocated next
/// shows in `residentBytes`.
void releaseFreedMemory();

}  // namespace quadrille::bench
