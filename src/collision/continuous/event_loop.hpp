#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "collision/continuous/event_queue.hpp"
#include "collision/continuous/event_search.hpp"
#include "collision/resolver.hpp"

namespace quadrille {

/// The part of a run that a loop of events belongs to.
template <class Real>
struct EventWindow {
    double to;       ///< s; the events until then are carried out
    double horizon;  ///< s; those until then are found
    Real reach;      ///< px; how far a body may be from its position in the columns
};

/// What a loop of events keeps from step to step.
struct EventLoopState {
    /// Bodies that are pushed together.
    struct Group {
        std::vector<std::uint32_t> rows;
        double mass = 0;
        bool held = false;
    };

    EventQueue queue;
    std::vector<std::uint32_t> changed;  ///< bodies whose events are to be found again
    double fastest = 0;                  ///< px/s, of what events gave to bodies

    /// Overlapping pairs that collided at the present instant.
    double instant = -1;  ///< s
    std::vector<std::pair<std::uint32_t, std::uint32_t>> separated;

    Group groupA, groupB;
    std::vector<std::uint32_t> groupChanged;
    std::vector<std::uint64_t> gathered;  ///< by which gathering a body was gathered last
    std::uint64_t gathering = 0;

    std::size_t bytes() const {
        return queue.bytes() +
               (changed.capacity() + 2 * separated.capacity() + groupA.rows.capacity() +
                groupB.rows.capacity() + groupChanged.capacity() + 2 * gathered.capacity()) *
                   sizeof(std::uint32_t);
    }
};

/// Carries events out in the order of time, and has the next ones of the bodies found that they
/// change.
///
/// Equal masses that collide elastically exchange trajectories, shifted by the distance of their
/// centres: no rounding at all where sizes and anchors lie on a lattice of doubles.
///
/// Pairs that overlap all the same, from the start or by an ulp of rounding, count as touching on
/// their axis of least penetration and collide only if they approach (Bannerman et al.,
/// arXiv:1211.6718), once at any instant.
///
/// Two thresholds end what would otherwise have no end. A rebound off something that holds is none
/// if gravity would bring it back before it left the rounding of positions: the body then rests,
/// without acceleration, until it is hit, or slides off its last support. Where restitution is
/// below 1, pairs that would part slower than `restSpeed` go on with their common velocity. And a
/// body that rests is held by its support: with restitution below 1, what falls on it rebounds as
/// from the support itself (Newton's law for simultaneous impacts; Moreau 1988), so that a pile
/// does not pass each impact down and up again without end.
template <class Real, class Path>
class EventLoop {
  public:
    using Search = EventSearch<Real, Path>;
    using Motion = typename Search::Motion;

    /// Far more events per body and step than any scene has; a loop without progress ends here.
    static constexpr std::uint64_t mostEventsPerBody = 100'000;

    /// All must outlive this.
    EventLoop(const Search& search, EventLoopState& state, const EventWindow<Real>& window)
        : search_(search), motion_(search.motion()), state_(state), window_(window) {}

    /// Lets fall bodies that have changed, and what rested on them, and what rested on that, unless
    /// something holds them.
    void releaseFromChanged(double now);

    /// Finds what happens to the bodies that have changed and those that `othersOf(row)` gives.
    template <class OthersOf>
    void findForChanged(double now, OthersOf&& othersOf) {
        for (const std::uint32_t row : state_.changed) {
            search_.findFor(row, othersOf(row), now, window_.horizon, state_.queue);
        }
        state_.changed.clear();
    }

    /// Brings what the events will read into the cache, all at once: one after the other they would
    /// wait for each.
    void prefetch() const {
#if defined(__GNUC__)
        for (const PairEvent& event : state_.queue.due()) {
            for (const std::uint32_t row : {event.a, event.b}) {
                if (Motion::isStatic(row)) continue;
                for (const std::uint32_t b : search_.neighbours()[row]) {
                    if (!Motion::isStatic(b)) {
                        __builtin_prefetch(motion_.moving().anchors->rows.data() + b);
                    }
                }
            }
        }
#endif
    }

    /// Carries out the events of the window. Calls `admit(event)` before each, which ends the loop
    /// if it is false; `collided(event, record)` after a collision; `othersOf(row)` for the bodies
    /// that one that has changed may meet. Returns whether all were carried out: an event that
    /// makes a body too fast for the partition is the last, and its bodies stay in
    /// EventLoopState::changed.
    template <class Admit, class Collided, class OthersOf>
    bool run(Admit&& admit, Collided&& collided, OthersOf&& othersOf) {
        while (!state_.queue.empty()) {
            const PairEvent event = state_.queue.pop();
            if (!search_.isCurrent(event)) continue;
            stoppedAt_ = event.time;
            if (!admit(event)) return false;
            ContactRecord record{};
            if (!resolve(event, record)) continue;
            if (record.axes != 0) collided(event, record);
            if constexpr (falls) releaseFromChanged(event.time);
            for (const std::uint32_t row : state_.changed) {
                if (leavesPartition(row, event.time)) return false;
            }
            findForChanged(event.time, othersOf);
        }
        return true;
    }

    /// The time of the last event, s.
    double stoppedAt() const { return stoppedAt_; }

  private:
    static constexpr bool falls = Path::falls;
    enum class Outcome : std::uint8_t { Nothing, Touch, Collision };
    using Group = EventLoopState::Group;

    bool leavesPartition(std::uint32_t row, double now) const;
    void set(std::uint32_t row, int axis, double anchor, double velocity, double time);
    void changed(std::uint32_t row);
    bool separatedAlready(const PairEvent& event);
    double creep(double va, double vb) const;
    double surfaceFor(const PairEvent& event, std::uint32_t row, std::uint32_t other, int axis,
                      double sense) const;

    bool resolve(const PairEvent& event, ContactRecord& record);
    Outcome collide(const PairEvent& event, int axis, double sense);
    void exchange(const PairEvent& event, int axis, double sense);
    void bounceOff(const PairEvent& event, std::uint32_t row, std::uint32_t off, int axis,
                   double sense);

    // ---- bodies that are pushed together
    void gather(std::uint32_t row, int axis, double sense, double now, Group& group);
    void move(const Group& group, int axis, double velocity, double now);
    void collideGroups(const PairEvent& event, int axis, double sense);

    // ---- bodies at rest
    bool supported(std::uint32_t row, int axis, double now) const;
    bool release(std::uint32_t row, int axis, double now);

    const Search& search_;
    const Motion& motion_;
    EventLoopState& state_;
    EventWindow<Real> window_;
    double stoppedAt_ = 0;  // s
};

}  // namespace quadrille
