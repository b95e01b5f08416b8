#pragma once

namespace quadrille {

/// Where, when and how fast a body set out on its present path, along each axis: one record,
/// because an event reads all of it.
template <class Real>
struct Anchor {
    Real x, y;            ///< px
    Real vx, vy;          ///< px/s
    double timeX, timeY;  ///< s; NaN for a body that is new or was edited from outside
};

}  // namespace quadrille
