#pragma once

#include <cstdint>
#include <limits>

#include "collision/rules/bodies.hpp"
#include "collision/rules/pair_contact.hpp"

/// Which pairs of boxes overlap, for host and device alike: sums and differences are taken in one
/// order, so that rounding shows everybody the same pairs.

namespace quadrille {

/// A box by its centre and half extents, px.
template <class Real>
struct Box {
    Real x, y, halfWidth, halfHeight;
};

template <class Real>
QUADRILLE_HD inline Box<Real> movingBox(const Bodies<Real>& bodies, std::uint32_t row) {
    const auto& m = bodies.moving;
    return {m.x[row], m.y[row], m.halfWidth[row], m.halfHeight[row]};
}

template <class Real>
QUADRILLE_HD inline Box<Real> staticBox(const Bodies<Real>& bodies, std::uint32_t row) {
    const auto& f = bodies.fixed;
    return {f.x[row], f.y[row], f.halfWidth[row], f.halfHeight[row]};
}

template <class Real>
QUADRILLE_HD inline bool overlap(const Box<Real>& a, const Box<Real>& b) {
    return overlaps(b.x - a.x, b.y - a.y, a.halfWidth + b.halfWidth, a.halfHeight + b.halfHeight);
}

/// The box of either kind of body.
template <class Real>
QUADRILLE_HD inline Box<Real> boxOf(const Bodies<Real>& bodies, BodyRef body) {
    return body.isStatic() ? staticBox(bodies, body.row()) : movingBox(bodies, body.row());
}

/// Whether a moving body overlaps another one.
template <class Real>
QUADRILLE_HD inline bool overlap(const Bodies<Real>& bodies, std::uint32_t a, BodyRef b) {
    return overlap(movingBox(bodies, a), boxOf(bodies, b));
}

/// The first of a pair, made larger by what is to be added to the sums of half extents. In a cell
/// the first is the static body of the pair, or of two moving ones the one that stands first.
template <class Real>
QUADRILLE_HD inline Box<Real> inflated(const Box<Real>& first, Real inflation) {
    return {first.x, first.y, first.halfWidth + inflation, first.halfHeight + inflation};
}

/// What to add to the sums of half extents to find all pairs that can meet while each body stays
/// within `margin` of where it is: a little more than the margins of both, for the rounding of the
/// distances walked and of the sums themselves. `largest` is the largest half extent.
template <class Real>
QUADRILLE_HD inline Real candidateInflation(Real margin, Real largest) {
    constexpr Real eps = 16 * std::numeric_limits<Real>::epsilon();
    return 2 * margin * (1 + eps) + largest * eps;
}

}  // namespace quadrille
