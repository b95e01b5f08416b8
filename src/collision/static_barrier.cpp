#include "collision/static_barrier.hpp"

namespace quadrille {

namespace {

template <class Real>
Box<Real> moved(const Box<Real>& body, const Place<Real>& to) {
    return {to.x, to.y, body.halfWidth, body.halfHeight};
}

/// The box around the body in both places.
template <class Real>
Box<Real> swept(const Box<Real>& body, const Place<Real>& from, const Place<Real>& to) {
    const Real x = (from.x + to.x) / 2;
    const Real y = (from.y + to.y) / 2;
    const Real wayX = magnitude(to.x - from.x);
    const Real wayY = magnitude(to.y - from.y);
    // A little more, as the middle is rounded.
    return {x, y, body.halfWidth + wayX / 2 + roundingOf(x, wayX),
            body.halfHeight + wayY / 2 + roundingOf(y, wayY)};
}

}  // namespace

template <class Real>
void StaticBarrier<Real>::update(const LawBodies<Real>& bodies) {
    if (made_ && layout_ == bodies.layout) return;
    map_.update(bodies.read());
    layout_ = bodies.layout;
    made_ = true;
}

/// Where a body gets along one axis.
template <class Real>
Place<Real> StaticBarrier<Real>::goAlong(const Box<Real>& body, const Box<Real>& region,
                                         const Place<Real>& from, const Place<Real>& to,
                                         bool alongX) const {
    Place<Real> at = from;
    (alongX ? at.x : at.y) = alongX ? to.x : to.y;
    map_.forEachIn(region, [&](const Box<Real>& fixed) {
        const ObstacleBox<Real> box(body, fixed);
        if (alongX && box.y.holds(from.y) && !box.x.holds(from.x)) {
            at.x = box.x.stop(from.x, at.x);
        } else if (!alongX && box.x.holds(from.x) && !box.y.holds(from.y)) {
            at.y = box.y.stop(from.y, at.y);
        }
    });
    return at;
}

/// Goes straight if nothing is in the way, and else along the axis whose gap closes first, and then
/// along the other. What a body is in from the start lets it out.
template <class Real>
auto StaticBarrier<Real>::travel(const Box<Real>& body, const Place<Real>& from,
                                 const Place<Real>& to) const -> Arrival {
    const Box<Real> region = swept(body, from, to);
    bool inside = false;
    bool blocked = false;
    bool xLast = false;
    map_.forEachIn(region, [&](const Box<Real>& fixed) {
        const ObstacleBox<Real> box(body, fixed);
        if (box.holds(from)) {
            inside = true;
        } else if (box.blocks(from, to)) {
            blocked = true;
            xLast = xLast || box.meetsLastAlongX(from, to);
        }
    });
    if (!blocked) return {to, inside};
    const Place<Real> corner = goAlong(body, region, from, to, !xLast);
    return {goAlong(body, region, corner, to, xLast), inside};
}

/// Where a body would be without the static box that it is deepest in; where it is if it is in
/// none.
template <class Real>
Place<Real> StaticBarrier<Real>::pushedOut(const Box<Real>& body, const Place<Real>& at) const {
    Place<Real> result = at;
    Real deepest = 0;
    map_.forEachIn(moved(body, at), [&](const Box<Real>& fixed) {
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

template <class Real>
Place<Real> StaticBarrier<Real>::keepOutNearby(const Box<Real>& body,
                                               const Place<Real>& start) const {
    const Arrival arrival = travel(body, start, {body.x, body.y});
    if (!arrival.inside) return arrival.place;
    // Between several that it started in, it stays where they leave it.
    return travel(body, arrival.place, pushedOut(body, arrival.place)).place;
}

template class StaticBarrier<double>;
template class StaticBarrier<float>;

}  // namespace quadrille
