#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <quadrille/bodies.hpp>

#include "collision/candidate_pairs.hpp"
#include "collision/partitioner.hpp"
#include "collision/resolver.hpp"
#include "collision/trajectory.hpp"

namespace quadrille {

/// The law `continuous` on one core: all events of a step in the order of time, found again for the
/// bodies that an event changed (event-driven simulation of hard bodies; Alder & Wainwright 1959).
///
/// Positions follow from anchors that change in events only, and an event's time from the
/// trajectories of its bodies only, so the state does not depend on dt. Equal masses exchange
/// trajectories, shifted by the distance of their centres: no rounding at all where sizes and
/// anchors lie on a lattice of doubles. Pairs that overlap all the same, from the start or by an
/// ulp of rounding, count as touching on their axis of least penetration and collide only if they
/// approach (Bannerman et al., arXiv:1211.6718), once at any instant.
template <class Real>
class SequentialContinuous {
  public:
    /// Anchors the bodies that have no anchor yet: all of them at first, later those that were
    /// created or edited from outside. Must be called at the start of each step.
    void anchor(const BodyView<Real>& bodies, double now);

    /// How far a body may move between two times, along either axis, unless an event makes it
    /// faster than every body is now.
    Real reach(const BodyView<Real>& bodies, double from, double to) const;

    /// Runs the events from `from` to `to`, the positions being those at `from`, and the partition
    /// one that covers `reach`. Returns `to`, or the time of an event that made a body too fast for
    /// the partition; then positions are to be placed there, and the call repeated with a new one.
    double advance(const BodyView<Real>& bodies, const Partition<Real>& partition, Real reach,
                   double from, double to, std::vector<ContactRecord>* records,
                   ResolveCounts& counts);

    /// Writes the positions of all bodies at time t.
    void place(const BodyView<Real>& bodies, double t) const;

    std::size_t bytes() const;

  private:
    static constexpr std::uint32_t staticBit = 0x8000'0000u;

    struct Event {
        double time;
        std::uint32_t priority;
        std::uint32_t a, b;  // rows; b with staticBit for a static body
        std::uint32_t stampA, stampB;
        std::uint8_t axes;  // 0 for a pair that overlaps already
    };
    struct Later;  // orders the heap
    struct Paths {
        Trajectory x, y;
    };

    Trajectory trajectory(const BodyView<Real>& bodies, std::uint32_t row, int axis) const;
    Trajectory other(const BodyView<Real>& bodies, std::uint32_t b, int axis) const;
    Paths pathsOf(const BodyView<Real>& bodies, std::uint32_t row) const;
    double reachOf(const BodyView<Real>& bodies, std::uint32_t a, std::uint32_t b, int axis) const;
    void set(const BodyView<Real>& bodies, std::uint32_t row, int axis, const Trajectory& to);

    void linkNeighbours(const BodyView<Real>& bodies);
    std::span<const std::uint32_t> neighbours(std::uint32_t row) const;

    void collectDue(double to);
    void push(const BodyView<Real>& bodies, double time, std::uint32_t a, std::uint32_t b,
              std::uint8_t axes);
    void find(const BodyView<Real>& bodies, std::uint32_t row, const Paths& paths, std::uint32_t b,
              double from, double to, bool afterEvent);
    void findFor(const BodyView<Real>& bodies, std::uint32_t row, double now, double to);
    void findAll(const BodyView<Real>& bodies, double from, double to);
    bool approaching(const BodyView<Real>& bodies, MovingPair pair, Real h) const;

    bool isCurrent(const Event& event) const;
    bool separatedAlready(const Event& event);
    std::uint8_t resolve(const BodyView<Real>& bodies, const Event& event, ContactRecord& record);
    bool collide(const BodyView<Real>& bodies, const Event& event, int axis, double sense);
    bool collideMoving(const BodyView<Real>& bodies, const Event& event, int axis, double sense);
    bool collideStatic(const BodyView<Real>& bodies, const Event& event, int axis, double sense);
    bool leavesPartition(const BodyView<Real>& bodies, std::uint32_t row, double now,
                         double to) const;

    Real reach_ = 0;       // of the current partition
    double horizon_ = -1;  // s; all meetings up to here have been found
    double stepEnd_ = -1;  // s

    CandidatePairs<Real> candidates_;
    std::vector<std::uint32_t> neighbourStarts_, neighbours_;
    std::vector<Event> heap_;    // events up to the end of the step
    std::vector<Event> future_;  // later ones, in no order
    std::vector<std::uint32_t>
        stamps_;  // events of each body so far; outdates what was found before
    std::vector<std::uint32_t> changed_;  // bodies whose events are to be found again
    // Overlapping pairs that collided at the present instant.
    double instant_ = -1;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> separated_;
};

}  // namespace quadrille
