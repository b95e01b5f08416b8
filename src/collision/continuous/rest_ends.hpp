#pragma once

#include <cstdint>
#include <span>

#include "collision/continuous/event_loop_state.hpp"
#include "collision/continuous/event_search.hpp"
#include "collision/continuous/event_window.hpp"
#include "collision/rules/rest_rules.hpp"

namespace quadrille {

/// Lets bodies fall that rested when nothing holds them any more.
template <class Real, class Path>
class RestEnds {
  public:
    using Search = EventSearch<Real, Path>;

    /// All must outlive this.
    RestEnds(const Search& search, EventLoopState& state, const EventWindow& window)
        : search_(search), state_(state), window_(window) {}

    /// Carries out the end of a support. Returns whether any body falls.
    bool release(const PairEvent& event);

    /// Looks at the bodies that have changed, at what rested on them, and at what rested on that.
    void releaseFromChanged(double now);

  private:
    std::span<const BodyRef> supportsOf(std::uint32_t row);
    bool release(std::uint32_t row, int axis, double now);

    const Search& search_;
    EventLoopState& state_;
    const EventWindow& window_;
};

}  // namespace quadrille
