#pragma once

#include <cstdint>

#include "collision/continuous/event_loop_state.hpp"
#include "collision/continuous/event_search.hpp"
#include "collision/continuous/event_window.hpp"
#include "collision/rules/event_rules.hpp"

namespace quadrille {

/// Collisions with restitution below 1. Bodies that touch and move together act as one: what is
/// pushed pushes in turn, and all at once (Moreau's law of simultaneous impacts). One after the
/// other they would take a number of collisions without end to come to the same velocity.
template <class Real, class Path>
class PushedGroups {
  public:
    using Search = EventSearch<Real, Path>;
    using Motion = typename Search::Motion;

    /// All must outlive this.
    PushedGroups(const Search& search, EventLoopState& state, const EventWindow& window)
        : search_(search), state_(state), window_(window) {}

    /// Carries out one axis of an event with the restitution of `motion`, and returns the impulse,
    /// kg px/s. All bodies that it moves are added to EventLoopState::groupChanged.
    double collide(const Motion& motion, const PairEvent& event, int axis, double sense);

  private:
    void gather(const Motion& motion, std::uint32_t row, int axis, double sense, double now,
                PushedGroup& group);
    void move(const PushedGroup& group, int axis, double velocity, double now);

    const Search& search_;
    EventLoopState& state_;
    const EventWindow& window_;
};

}  // namespace quadrille
