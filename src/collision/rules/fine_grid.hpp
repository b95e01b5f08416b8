#pragma once

#include <cstdint>
#include <limits>

#include <quadrille/detail/host_device.hpp>

#include "collision/rules/cell_ownership.hpp"
#include "collision/rules/pair_contact.hpp"

namespace quadrille {

/// Maps the plane to integer cells, on host and device alike. The map is monotone and clamped, so
/// cells are half-open, border cells reach to infinity, and which cell holds a point is decided by
/// integers alone: rounding cannot make two bodies disagree about a border. As made by default, a
/// single cell.
template <class Real>
struct FineGrid {
    Real lowX = 0, lowY = 0;    ///< px
    Real perX = 0, perY = 0;    ///< fine cells per px
    Real lastX = 0, lastY = 0;  ///< highest cell number

    static constexpr Real eps = 4 * std::numeric_limits<Real>::epsilon();

    QUADRILLE_HD static std::uint16_t coordinate(Real position, Real low, Real per, Real last) {
        Real cell = (position - low) * per;
        cell = cell > 0 ? cell : 0;
        cell = cell < last ? cell : last;
        return static_cast<std::uint16_t>(static_cast<std::int32_t>(cell));
    }

    /// The cells that the box around (x, y) touches.
    QUADRILLE_HD FineRange range(Real x, Real y, Real halfWidth, Real halfHeight) const {
        // Rounding of x +- halfWidth must not tear apart two boxes that `overlaps` says overlap.
        const Real reachX = halfWidth + eps * (magnitude(x) + halfWidth - lowX);
        const Real reachY = halfHeight + eps * (magnitude(y) + halfHeight - lowY);
        return {
            coordinate(x - reachX, lowX, perX, lastX), coordinate(y - reachY, lowY, perY, lastY),
            coordinate(x + reachX, lowX, perX, lastX), coordinate(y + reachY, lowY, perY, lastY)};
    }
};

}  // namespace quadrille
