#pragma once

#include <cstdint>

#include <quadrille/detail/host_device.hpp>

#include "collision/rules/bodies.hpp"
#include "collision/rules/pair_contact.hpp"
#include "collision/rules/pair_geometry.hpp"
#include "collision/rules/static_map_view.hpp"

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

template <class Real>
QUADRILLE_HD inline Box<Real> moved(const Box<Real>& body, const Place<Real>& to) {
    return {to.x, to.y, body.halfWidth, body.halfHeight};
}

/// The box around the body in both places.
template <class Real>
QUADRILLE_HD inline Box<Real> swept(const Box<Real>& body, const Place<Real>& from,
                                    const Place<Real>& to) {
    const Real x = (from.x + to.x) / 2;
    const Real y = (from.y + to.y) / 2;
    const Real wayX = magnitude(to.x - from.x);
    const Real wayY = magnitude(to.y - from.y);
    // A little more, as the middle is rounded.
    return {x, y, body.halfWidth + wayX / 2 + roundingOf(x, wayX),
            body.halfHeight + wayY / 2 + roundingOf(y, wayY)};
}

/// Where a body gets along one axis.
template <class Real>
QUADRILLE_HD inline Place<Real> goAlong(const StaticMapView<Real>& map, const Box<Real>& body,
                                        const Box<Real>& region, const Place<Real>& from,
                                        const Place<Real>& to, bool alongX) {
    Place<Real> at = from;
    (alongX ? at.x : at.y) = alongX ? to.x : to.y;
    map.forEachIn(region, [&](const Box<Real>& fixed) {
        const ObstacleBox<Real> box(body, fixed);
        if (alongX && box.y.holds(from.y) && !box.x.holds(from.x)) {
            at.x = box.x.stop(from.x, at.x);
        } else if (!alongX && box.x.holds(from.x) && !box.y.holds(from.y)) {
            at.y = box.y.stop(from.y, at.y);
        }
    });
    return at;
}

/// Where a body gets on its way, and whether it is in a static box that it was in before.
template <class Real>
struct Arrival {
    Place<Real> place;
    bool inside;
};

/// Goes straight if nothing is in the way, and else along the axis whose gap closes first, and then
/// along the other. What a body is in from the start lets it out.
template <class Real>
QUADRILLE_HD inline Arrival<Real> travel(const StaticMapView<Real>& map, const Box<Real>& body,
                                         const Place<Real>& from, const Place<Real>& to) {
    const Box<Real> region = swept(body, from, to);
    bool inside = false;
    bool blocked = false;
    bool xLast = false;
    map.forEachIn(region, [&](const Box<Real>& fixed) {
        const ObstacleBox<Real> box(body, fixed);
        if (box.holds(from)) {
            inside = true;
        } else if (box.blocks(from, to)) {
            blocked = true;
            xLast = xLast || box.meetsLastAlongX(from, to);
        }
    });
    if (!blocked) return {to, inside};
    const Place<Real> corner = goAlong(map, body, region, from, to, !xLast);
    return {goAlong(map, body, region, corner, to, xLast), inside};
}

/// Where a body would be without the static box that it is deepest in; where it is if it is in
/// none.
template <class Real>
QUADRILLE_HD inline Place<Real> pushedOut(const StaticMapView<Real>& map, const Box<Real>& body,
                                          const Place<Real>& at) {
    Place<Real> result = at;
    Real deepest = 0;
    map.forEachIn(moved(body, at), [&](const Box<Real>& fixed) {
        const ObstacleBox<Real> box(body, fixed);
        if (!box.holds(at)) return;
        const Real depthX = box.x.depth(at.x);
        const Real depthY = box.y.depth(at.y);
        const bool alongX = depthX <= depthY;
        const Real depth = alongX ? depthX : depthY;
        Place<Real> out = at;
        if (alongX) {
            out.x += fixed.x >= at.x ? -depth : depth;
        } else {
            out.y += fixed.y >= at.y ? -depth : depth;
        }
        // Of equal ones any will do that does not depend on their order.
        const bool lower = out.x < result.x || (out.x == result.x && out.y < result.y);
        if (depth > deepest || (depth == deepest && lower)) {
            deepest = depth;
            result = out;
        }
    });
    return result;
}

/// keepOut() where something is near.
template <class Real>
QUADRILLE_HD inline Place<Real> keepOutNearby(const StaticMapView<Real>& map, const Box<Real>& body,
                                              const Place<Real>& start) {
    const Arrival<Real> arrival = travel(map, body, start, {body.x, body.y});
    if (!arrival.inside) return arrival.place;
    // Between several that it started in, it stays where they leave it.
    return travel(map, body, arrival.place, pushedOut(map, body, arrival.place)).place;
}

/// Where a body that stood at `start` is to stand, contacts having put it where `body` is.
template <class Real>
QUADRILLE_HD inline Place<Real> keepOut(const StaticMapView<Real>& map, const Box<Real>& body,
                                        const Place<Real>& start) {
    const Real roomX = body.halfWidth + magnitude(body.x - start.x);
    const Real roomY = body.halfHeight + magnitude(body.y - start.y);
    if (map.clear(body.x, body.y, roomX, roomY)) return {body.x, body.y};
    return keepOutNearby(map, body, start);
}

/// The same for the body in a row. Once a step: what is between two static boxes would be pushed on
/// by a second time.
template <class Real>
QUADRILLE_HD inline void keepOut(const StaticMapView<Real>& map, const Bodies<Real>& bodies,
                                 std::uint32_t row, const Place<Real>& start) {
    const Place<Real> place = keepOut(map, movingBox(bodies, row), start);
    bodies.moving.x[row] = place.x;
    bodies.moving.y[row] = place.y;
}

}  // namespace quadrille
