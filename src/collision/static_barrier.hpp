#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "collision/law_bodies.hpp"
#include "collision/rules/keep_out.hpp"
#include "collision/static_map.hpp"

namespace quadrille {

/// What makes static boxes final for the law `impulse`: see rules/keep_out.hpp. Every resolver asks
/// it on the host, body by body in any order.
template <class Real>
class StaticBarrier {
  public:
    /// Takes over the static boxes of this step.
    void update(const LawBodies<Real>& bodies);

    /// Whether there is anything to stay out of.
    bool any() const { return !map_.empty(); }

    /// Where a body that stood at `start` is to stand, contacts having put it where `body` is.
    Place<Real> keepOut(const Box<Real>& body, const Place<Real>& start) const {
        const Real roomX = body.halfWidth + magnitude(body.x - start.x);
        const Real roomY = body.halfHeight + magnitude(body.y - start.y);
        if (map_.clear(body.x, body.y, roomX, roomY)) return {body.x, body.y};
        return keepOutNearby(body, start);
    }

    /// The same for the body in a row. Once a step: what is between two static boxes would be
    /// pushed on by a second time.
    void keepOut(const Bodies<Real>& bodies, std::uint32_t row, const Place<Real>& start) const {
        const Place<Real> place = keepOut(movingBox(bodies, row), start);
        bodies.moving.x[row] = place.x;
        bodies.moving.y[row] = place.y;
    }

    std::size_t bytes() const { return map_.bytes(); }

  private:
    Place<Real> keepOutNearby(const Box<Real>& body, const Place<Real>& start) const;
    /// Where a body gets on its way, and whether it is in a static box that it was in before.
    struct Arrival {
        Place<Real> place;
        bool inside;
    };
    Arrival travel(const Box<Real>& body, const Place<Real>& from, const Place<Real>& to) const;
    Place<Real> goAlong(const Box<Real>& body, const Box<Real>& region, const Place<Real>& from,
                        const Place<Real>& to, bool alongX) const;
    Place<Real> pushedOut(const Box<Real>& body, const Place<Real>& at) const;

    StaticMap<Real> map_;
    std::uint64_t layout_ = 0;  // of the bodies that the map is of
    bool made_ = false;
};

}  // namespace quadrille
