#pragma once

#include <algorithm>
#include <cstddef>

#include <quadrille/bodies.hpp>

#include "parallel/thread_team.hpp"

namespace quadrille {

/// The largest half extent of any body along either axis, px.
template <class Real>
Real largestHalfExtent(const BodyView<Real>& bodies,
                       const ThreadTeam& team = ThreadTeam::serial()) {
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    Real result = std::max(m.halfWidth.common, m.halfHeight.common);
    for (const auto values : {m.halfWidth.values, m.halfHeight.values, f.halfWidth, f.halfHeight}) {
        const Real most = team.maximum<Real>(values.size(), &Thresholds::streamed,
                                             [&](std::size_t begin, std::size_t end) {
                                                 Real part = 0;
                                                 for (std::size_t i = begin; i < end; ++i)
                                                     part = std::max(part, values[i]);
                                                 return part;
                                             });
        result = std::max(result, most);
    }
    return result;
}

}  // namespace quadrille
