#pragma once

#include <cstdint>
#include <span>

#include "collision/continuous/event_queue.hpp"
#include "collision/continuous/path_sketches.hpp"
#include "collision/pairs/cell_walk.hpp"
#include "collision/pairs/neighbours.hpp"
#include "collision/rules/next_event.hpp"

namespace quadrille {

/// Finds what happens next to pairs of bodies, for the law `continuous`. Every function pushes the
/// events that it finds to a queue.
template <class Real, class Path>
class EventSearch {
  public:
    using Motion = ExactMotion<Real, Path>;

    /// `stamps` count the changes of each moving body's path; they, the neighbours, and the
    /// sketches of the paths must outlive this.
    EventSearch(const Motion& motion, const Neighbours& neighbours, std::span<std::uint32_t> stamps,
                PathSketches<Real, Path>& sketches)
        : motion_(motion), neighbours_(neighbours), stamps_(stamps), sketches_(sketches) {}

    const Motion& motion() const { return motion_; }
    const Neighbours& neighbours() const { return neighbours_; }

    /// How many moving bodies there are.
    std::size_t rows() const { return stamps_.size(); }

    /// Whether the paths are those that the event was found from.
    bool isCurrent(const PairEvent& event) const {
        return event.stampA == stamps_[event.a] &&
               (event.withStatic() || event.stampB == stamps_[event.b.row()]);
    }
    std::uint32_t stamp(std::uint32_t row) const { return stamps_[row]; }

    /// The body's path is another one: what was found from the old one is void.
    void changed(std::uint32_t row) const { restore(row, stamps_[row] + 1); }
    /// The body's path is again the one that it was when it had this stamp.
    void restore(std::uint32_t row, std::uint32_t stamp) const {
        stamps_[row] = stamp;
        sketches_.redraw(motion_, row);
    }

    /// Brings into the cache what the present events and the search after them will read, all at
    /// once: one after the other they would wait for each.
    void prefetch(const EventQueue& queue) const {
#if defined(__GNUC__)
        const auto forBodies = [&](auto&& function) {
            queue.forEachPresent([&](const PairEvent& event) {
                function(event.a);
                if (!event.withStatic()) function(event.b.row());
            });
        };
        forBodies([&](std::uint32_t row) {
            const auto* const anchor = motion_.bodies.moving.anchors + row;
            neighbours_.prefetch(row);
            __builtin_prefetch(anchor);
            __builtin_prefetch(&anchor->timeY);
            __builtin_prefetch(stamps_.data() + row);
        });
        forBodies([&](std::uint32_t row) { neighbours_.prefetchList(row); });
        forBodies([&](std::uint32_t row) {
            for (const BodyRef b : neighbours_[row]) {
                if (!b.isStatic()) sketches_.prefetch(b.row());
            }
        });
#endif
    }

    /// All meetings of candidates between `from`, when positions are up to date, and `to`.
    void findAmong(std::span<const MovingPair> pairs, double from, double to,
                   EventQueue& queue) const {
        const auto emit = into(queue);
        sketches_.forEachNear(pairs, from, to, [&](MovingPair p) {
            findBetween(motion_, p.a, BodyRef::moving(p.b), from, to, emit);
        });
    }
    void findAmong(std::span<const StaticPair> pairs, double from, double to,
                   EventQueue& queue) const {
        const auto emit = into(queue);
        for (const StaticPair p : pairs) {
            findBetween(motion_, p.a, BodyRef::fixed(p.fixed), from, to, emit);
        }
    }

    /// What happens after an event at time `now` to a body that it changed and some of its
    /// neighbours, until `to`.
    void findFor(std::uint32_t row, std::span<const BodyRef> others, double now, double to,
                 EventQueue& queue) const {
        const auto emit = into(queue);
        sketches_.forEachNear(row, others, now, to, [&](std::span<const BodyRef> near) {
            quadrille::findFor(motion_, row, near, now, to, emit);
        });
    }

  private:
    auto into(EventQueue& queue) const {
        return [&](PairEvent event) {
            event.stampA = stamps_[event.a];
            if (!event.withStatic()) event.stampB = stamps_[event.b.row()];
            queue.push(event);
        };
    }

    const Motion motion_;
    const Neighbours& neighbours_;
    std::span<std::uint32_t> stamps_;
    PathSketches<Real, Path>& sketches_;
};

}  // namespace quadrille
