#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/vec2.hpp>

#include "collision/cell_ownership.hpp"
#include "collision/thread_team.hpp"

namespace quadrille {

/// Maps the plane to integer cells. The map is monotone and clamped, so cells are half-open, border
/// cells reach to infinity, and which cell holds a point is decided by integers alone: rounding
/// cannot make two bodies disagree about a border.
template <class Real>
struct FineGrid {
    Real lowX, lowY;    ///< px
    Real perX, perY;    ///< fine cells per px
    Real lastX, lastY;  ///< highest cell number

    FineGrid(const Vec2& origin, const Vec2& cell, std::uint32_t columns, std::uint32_t rows)
        : lowX(static_cast<Real>(origin.x())),
          lowY(static_cast<Real>(origin.y())),
          perX(static_cast<Real>(1 / cell.x())),
          perY(static_cast<Real>(1 / cell.y())),
          lastX(static_cast<Real>(columns - 1)),
          lastY(static_cast<Real>(rows - 1)) {}

    static std::uint16_t coordinate(Real position, Real low, Real per, Real last) {
        Real cell = (position - low) * per;
        cell = cell > 0 ? cell : 0;
        cell = cell < last ? cell : last;
        return static_cast<std::uint16_t>(static_cast<std::int32_t>(cell));
    }

    FineRange range(Real x, Real y, Real halfWidth, Real halfHeight) const {
        // Rounding of x +- halfWidth must not tear apart two boxes that `overlaps` says overlap.
        constexpr Real eps = 4 * std::numeric_limits<Real>::epsilon();
        const Real reachX = halfWidth + eps * (std::abs(x) + halfWidth - lowX);
        const Real reachY = halfHeight + eps * (std::abs(y) + halfHeight - lowY);
        return {
            coordinate(x - reachX, lowX, perX, lastX), coordinate(y - reachY, lowY, perY, lastY),
            coordinate(x + reachX, lowX, perX, lastX), coordinate(y + reachY, lowY, perY, lastY)};
    }

    /// Ranges of all bodies, moving ones first, with every box inflated by `margin` on each side.
    void ranges(const BodyView<Real>& bodies, Real margin, std::vector<FineRange>& out,
                const ThreadTeam& team) const {
        out.resize(bodies.size());
        team.shares(bodies.moving.size(), worthwhile::built,
                    [&](std::size_t begin, std::size_t end, unsigned) {
                        movingRanges(bodies, margin, begin, end, out.data());
                    });
        const auto& f = bodies.fixed;
        for (std::size_t k = 0; k < f.size(); ++k) {
            out[bodies.moving.size() + k] =
                range(f.x[k], f.y[k], f.halfWidth[k] + margin, f.halfHeight[k] + margin);
        }
    }

  private:
    void movingRanges(const BodyView<Real>& bodies, Real margin, std::size_t begin, std::size_t end,
                      FineRange* out) const {
        const auto& m = bodies.moving;
        if (m.halfWidth.uniform() && m.halfHeight.uniform()) {
            const Real halfWidth = m.halfWidth.common + margin;
            const Real halfHeight = m.halfHeight.common + margin;
            for (std::size_t i = begin; i < end; ++i) {
                out[i] = range(m.x[i], m.y[i], halfWidth, halfHeight);
            }
        } else {
            for (std::size_t i = begin; i < end; ++i) {
                out[i] = range(m.x[i], m.y[i], m.halfWidth[i] + margin, m.halfHeight[i] + margin);
            }
        }
    }
};

}  // namespace quadrille
