#pragma once

#include <cstdint>
#include <span>

#include "collision/continuous/event_queue.hpp"
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

    /// `stamps` count the changes of each moving body's path; they and the neighbours must outlive
    /// this.
    EventSearch(const Motion& motion, const Neighbours& neighbours, std::span<std::uint32_t> stamps)
        : motion_(motion), neighbours_(neighbours), stamps_(stamps) {}

    const Motion& motion() const { return motion_; }
    const Neighbours& neighbours() const { return neighbours_; }

    /// How many moving bodies there are.
    std::size_t rows() const { return stamps_.size(); }

    /// Whether the paths are those that the event was found from.
    bool isCurrent(const PairEvent& event) const {
        return event.stampA == stamps_[event.a] &&
               (event.withStatic() || event.stampB == stamps_[event.b.row()]);
    }
    std::uint32_t& stamp(std::uint32_t row) const { return stamps_[row]; }

    /// All meetings of candidates between `from`, when positions are up to date, and `to`.
    void findAmong(std::span<const MovingPair> pairs, double from, double to,
                   EventQueue& queue) const {
        const auto emit = into(queue);
        for (const MovingPair p : pairs) {
            findBetween(motion_, p.a, BodyRef::moving(p.b), from, to, emit);
        }
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
        quadrille::findFor(motion_, row, others, now, to, into(queue));
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
};

}  // namespace quadrille
