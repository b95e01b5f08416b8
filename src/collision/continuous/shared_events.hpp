#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "collision/continuous/event_islands.hpp"
#include "collision/continuous/event_loop.hpp"
#include "collision/continuous/event_search.hpp"
#include "collision/law.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// Carries out the events of a step on several threads, bit for bit as one EventLoop does.
///
/// 1. The events known when the step begins are split by islands (EventIslands).
/// 2. Each worker runs a loop of its own over the events of its islands. It leaves out what its
///    bodies may do with those of other workers: that happens after the step.
/// 3. When all are done, these events are found from where the bodies are then.
///
/// All of this stands on how far a body can get in a step. Collisions of equal masses, and with
/// what holds, make nothing faster than the fastest body was, and gravity does so by a bounded
/// amount; but positions are rounded, and a heavy body may hit a light one. So every change of a
/// body is checked against the bound, and should one go too far, what has been done is undone.
/// Bodies that push each other, or rest on each other, touch, and so belong to one island.
template <class Real, class Path>
class SharedEvents {
  public:
    using Search = EventSearch<Real, Path>;

    /// `team` must outlive this.
    explicit SharedEvents(const ThreadTeam& team)
        : team_(team), islands_(team), shares_(team.size()) {}

    /// Whether to try again by now, after tries that did not work out.
    bool isWorthATry();

    /// Carries out the events of `whole` until the end of the window, if that is worth it and works
    /// out; returns whether it did, and has changed nothing if not. Two bodies meet in the window
    /// only if along both axes they are less than their size and `way`, in px, apart when it
    /// begins. Collisions go to `records`, in canonical order, unless it is null.
    bool run(const BodyView<Real>& bodies, const Search& search, EventLoopState& whole,
             const EventWindow& window, double way, std::vector<ContactRecord>* records,
             ResolveCounts& counts);

    std::size_t bytes() const;

  private:
    using Loop = EventLoop<Real, Path>;

    /// A body of an island as it was before.
    struct Before {
        std::uint32_t row, stamp;
        Anchor<Real> anchor;
        std::uint8_t rests;
    };
    /// A body that was changed, and one of another worker that it may meet after the step.
    struct Across {
        std::uint32_t row, stamp;
        BodyRef other;
    };
    struct Recorded {
        PairEvent after;  // the last in canonical order of the events so far
        std::size_t number;
        ContactRecord record;
    };
    struct alignas(64) Share {
        EventLoopState state;
        std::vector<Before> before;
        std::vector<Across> across;
        std::vector<BodyRef> others;
        std::vector<Recorded> records;
        ResolveCounts counts;
        bool complete = false;
    };

    bool tryRun(const BodyView<Real>& bodies, const Search& search, EventLoopState& whole,
                const EventWindow& window, double way, bool record);
    void keep(const Search& search, unsigned worker);
    void runShare(const Search& search, const EventLoopState& whole, const Bursts& bursts,
                  const EventWindow& window, bool record, unsigned worker);
    void findAcross(const Search& search, const EventWindow& window, Share& share);
    bool allComplete(std::uint64_t mostEvents) const;
    void undo(const Search& search, EventLoopState& whole);
    void finish(EventLoopState& whole, std::vector<ContactRecord>* records, ResolveCounts& counts);

    const ThreadTeam& team_;
    EventIslands islands_;
    std::vector<Share> shares_;
    std::vector<PairEvent> due_;
    std::vector<Recorded> records_;
    unsigned pause_ = 0;    // tries to do without after a split that did not work out,
    unsigned waiting_ = 0;  // and what is left of them
};

}  // namespace quadrille
