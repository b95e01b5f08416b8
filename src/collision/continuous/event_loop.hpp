#pragma once

#include <cstdint>

#include "collision/continuous/event_loop_state.hpp"
#include "collision/continuous/event_search.hpp"
#include "collision/continuous/event_window.hpp"
#include "collision/continuous/pushed_groups.hpp"
#include "collision/continuous/rest_ends.hpp"
#include "collision/law.hpp"
#include "collision/rules/event_rules.hpp"

namespace quadrille {

/// Carries events out in the order of time, and has the next ones of the bodies found that they
/// change.
template <class Real, class Path>
class EventLoop {
  public:
    using Search = EventSearch<Real, Path>;
    using Motion = typename Search::Motion;

    /// All must outlive this.
    EventLoop(const Search& search, EventLoopState& state, const EventWindow& window)
        : search_(search),
          motion_(search.motion()),
          state_(state),
          window_(window),
          groups_(search, state, window),
          resting_(search, state, window) {}

    /// Lets fall bodies that have changed, and what rested on them, and what rested on that, unless
    /// something holds them.
    void releaseFromChanged(double now) {
        if constexpr (falls) resting_.releaseFromChanged(now);
    }

    /// Finds what happens to the bodies that have changed and those that `othersOf(row)` gives.
    template <class OthersOf>
    void findForChanged(double now, OthersOf&& othersOf) {
        for (const std::uint32_t row : state_.changed) {
            search_.findFor(row, othersOf(row), now, window_.horizon, state_.queue);
        }
        state_.changed.clear();
    }

    /// Carries out the events of the window. Calls `admit(event)` before each, which ends the loop
    /// if it is false; `collided(event, record)` after a collision; `othersOf(row)` for the bodies
    /// that one that has changed may meet. Returns whether all were carried out: an event that
    /// makes a body too fast for the partition, or after which there were more than
    /// `window.mostEvents`, is the last, and its bodies stay in EventLoopState::changed.
    template <class Admit, class Collided, class OthersOf>
    bool run(Admit&& admit, Collided&& collided, OthersOf&& othersOf) {
        std::uint64_t carriedOut = 0;
        const auto begun = [&] { search_.prefetch(state_.queue); };
        begun();
        while (state_.queue.more(begun)) {
            const PairEvent event = state_.queue.pop();
            if (!search_.isCurrent(event)) continue;
            stoppedAt_ = event.time;
            if (!admit(event)) return false;
            ++carriedOut;
            ContactRecord record{};
            const bool changes = resolve(event, record);
            if (jammed_ && window_.isShared()) return false;
            if (!changes) continue;
            if (record.axes != 0) collided(event, record);
            releaseFromChanged(event.time);
            for (const std::uint32_t row : state_.changed) {
                if (outruns(motion_, row, event.time, window_.horizon, window_.bounds)) {
                    return false;
                }
            }
            if (carriedOut > window_.mostEvents) return false;
            findForChanged(event.time, othersOf);
        }
        return true;
    }

    /// The time of the last event, s.
    double stoppedAt() const { return stoppedAt_; }

  private:
    static constexpr bool falls = Path::falls;

    void changed(std::uint32_t row);
    bool separatedAlready(const PairEvent& event);
    bool isJammed(const PairEvent& event, const EventContact& contact);
    bool resolve(const PairEvent& event, ContactRecord& record);

    const Search& search_;
    const Motion& motion_;
    EventLoopState& state_;
    EventWindow window_;
    PushedGroups<Real, Path> groups_;
    RestEnds<Real, Path> resting_;
    double stoppedAt_ = 0;  // s
    bool jammed_ = false;   // a body collided so often at once that it gets nowhere
};

}  // namespace quadrille
