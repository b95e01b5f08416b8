#pragma once

#include <cstdint>

#include <quadrille/detail/host_device.hpp>

#include "collision/rules/bodies.hpp"
#include "collision/rules/contact_law.hpp"
#include "collision/rules/pair_geometry.hpp"

/// How a body that contacts have moved stays out of static boxes. It goes from where it stood at
/// the start of the step to where contacts have put it, along one axis and then the other, and no
/// further than the first static box in its way; so what overlapped no static box overlaps none
/// afterwards, whatever pushed it. Velocities are left alone: what still goes in touches at the
/// start of the next step, and is reflected there.

namespace quadrille {

template <class Real>
struct Place {
    Real x, y;  ///< px
};

/// Where a moving body stood when the step began, if it is at its end but for its contacts.
template <class Real>
QUADRILLE_HD inline Place<Real> placeBefore(const typename Bodies<Real>::Moving& m,
                                            std::uint32_t row, Real dt) {
    return {m.x[row] - m.vx[row] * dt, m.y[row] - m.vy[row] * dt};
}

/// A static box along one axis, as a moving body meets it.
template <class Real>
struct Obstacle {
    Real position, reach, slack;

    QUADRILLE_HD Obstacle(Real fixedPosition, Real sumOfHalves)
        : position(fixedPosition),
          reach(sumOfHalves),
          slack(roundingOf(fixedPosition, sumOfHalves)) {}

    /// By how much the body is in it, px; more than the slack if it does not just touch.
    QUADRILLE_HD Real depth(Real from) const { return reach - magnitude(position - from); }
    QUADRILLE_HD bool holds(Real from) const { return depth(from) > slack; }

    /// How far the body gets on the way from one place to another.
    QUADRILLE_HD Real stop(Real from, Real to) const {
        if (to > from) {
            const Real limit = position - reach;
            return position > from && to > limit ? limit : to;
        }
        const Real limit = position + reach;
        return position < from && to < limit ? limit : to;
    }
    QUADRILLE_HD bool passed(Real from, Real to) const {
        return (position > from) != (position > to) && !holds(from) && !holds(to);
    }
};

/// The static box in row k, as the moving body in a row meets it.
template <class Real>
struct ObstacleBox {
    Obstacle<Real> x, y;

    QUADRILLE_HD ObstacleBox(const Box<Real>& body, const Box<Real>& fixed)
        : x(fixed.x, body.halfWidth + fixed.halfWidth),
          y(fixed.y, body.halfHeight + fixed.halfHeight) {}

    QUADRILLE_HD bool holds(const Place<Real>& at) const { return x.holds(at.x) && y.holds(at.y); }

    /// Whether a body that comes from outside is in it, or has gone through it along an axis.
    QUADRILLE_HD bool blocks(const Place<Real>& from, const Place<Real>& to) const {
        return holds(to) || (y.holds(from.y) && y.holds(to.y) && x.passed(from.x, to.x)) ||
               (x.holds(from.x) && x.holds(to.x) && y.passed(from.y, to.y));
    }

    /// Whether a straight way reaches it round a corner, and last along x.
    QUADRILLE_HD bool meetsLastAlongX(const Place<Real>& from, const Place<Real>& to) const {
        if (x.holds(from.x) || y.holds(from.y)) return false;
        return -x.depth(from.x) * magnitude(to.y - from.y) >
               -y.depth(from.y) * magnitude(to.x - from.x);
    }
};

}  // namespace quadrille
