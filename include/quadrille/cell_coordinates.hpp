#pragma once

#include <cstdint>

namespace quadrille {

/// The square of fine cells that a cell of the partition covers: [x, x + 2^shift) on each axis.
struct CellCoordinates {
    std::uint16_t x = 0, y = 0;
    std::uint8_t shift = 0;
};

}  // namespace quadrille
