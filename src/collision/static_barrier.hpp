#pragma once

#include <cstddef>
#include <cstdint>

#include "collision/law_bodies.hpp"
#include "collision/rules/keep_out.hpp"
#include "collision/static_map.hpp"

namespace quadrille {

/// What makes static boxes final for the law `impulse`: see rules/keep_out.hpp. Whoever has
/// the bodies on the host asks it, body by body in any order.
template <class Real>
class StaticBarrier {
  public:
    /// Takes over the static boxes of this step.
    void update(const LawBodies<Real>& bodies);

    /// Whether there is anything to stay out of.
    bool any() const { return !map_.empty(); }

    /// See the rule.
    Place<Real> keepOut(const Box<Real>& body, const Place<Real>& start) const {
        return quadrille::keepOut(map_.view(), body, start);
    }
    void keepOut(const Bodies<Real>& bodies, std::uint32_t row, const Place<Real>& start) const {
        quadrille::keepOut(map_.view(), bodies, row, start);
    }

    std::size_t bytes() const { return map_.bytes(); }

  private:
    StaticMap<Real> map_;
    std::uint64_t layout_ = 0;  // of the bodies that the map is of
    bool made_ = false;
};

}  // namespace quadrille
