#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/vec2.hpp>

#include "collision/candidate_pairs.hpp"
#include "collision/partitioner.hpp"
#include "collision/resolver.hpp"
#include "collision/trajectory.hpp"

namespace quadrille {

/// The law `continuous` on one core: all events of a step in the order of time, found again for the
/// bodies that an event changed (event-driven simulation of hard bodies; Alder & Wainwright 1959).
///
/// Positions follow from anchors that change in events only, and an event's time from the
/// trajectories of its bodies only, so the state does not depend on dt. Equal masses that collide
/// elastically exchange trajectories, shifted by the distance of their centres: no rounding at all
/// where sizes and anchors lie on a lattice of doubles. Rounding elsewhere may leave two bodies
/// overlapping by an ulp; such a pair counts as touching on its axis of least penetration and
/// collides only if it approaches (Bannerman et al., arXiv:1211.6718).
template <class Real>
class SequentialContinuous {
  public:
    SequentialContinuous(const Vec2& gravity, double restitution);

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

    /// Writes the positions, and under gravity the velocities, of all bodies at time t.
    void place(const BodyView<Real>& bodies, double t) const;

    std::size_t bytes() const;

  private:
    enum class Kind : std::uint8_t { Meeting, Release };
    struct Event {
        double time;
        std::uint32_t priority;
        std::uint32_t a, b;  // rows; b with staticBit for a static body
        std::uint32_t stampA, stampB;
        std::uint8_t axes;
        Kind kind;
    };
    struct Later;  // orders the heap

    static constexpr std::uint32_t staticBit = 0x8000'0000u;

    Trajectory trajectory(const BodyView<Real>& bodies, std::uint32_t row, int axis) const;
    Trajectory other(const BodyView<Real>& bodies, std::uint32_t b, int axis) const;
    double reachOf(const BodyView<Real>& bodies, std::uint32_t a, std::uint32_t b, int axis) const;
    void set(const BodyView<Real>& bodies, std::uint32_t row, int axis, const Trajectory& to);
    bool resting(const BodyView<Real>& bodies, std::uint32_t row, int axis) const;
    void setResting(const BodyView<Real>& bodies, std::uint32_t row, int axis, bool rests);

    void linkNeighbours(const BodyView<Real>& bodies);
    std::span<const std::uint32_t> neighbours(std::uint32_t row) const;

    void findAll(const BodyView<Real>& bodies, double from, double to);
    void find(const BodyView<Real>& bodies, std::uint32_t a, std::uint32_t b, double from, double to,
              bool afterEvent);
    void findFor(const BodyView<Real>& bodies, std::uint32_t row, double now, double to);
    void findRelease(const BodyView<Real>& bodies, std::uint32_t row, double now, double to);
    void push(const BodyView<Real>& bodies, double time, std::uint32_t a, std::uint32_t b,
              std::uint8_t axes, Kind kind);

    bool supported(const BodyView<Real>& bodies, std::uint32_t row, int axis, double now) const;
    void wake(const BodyView<Real>& bodies, std::uint32_t row, int axis, double now);
    void wakeRestingOn(const BodyView<Real>& bodies, std::uint32_t row, int axis, double now);

    bool collide(const BodyView<Real>& bodies, const Event& event, int axis, int sense);
    bool collideMoving(const BodyView<Real>& bodies, const Event& event, int axis, double sense);
    bool collideStatic(const BodyView<Real>& bodies, const Event& event, int axis, double sense);
    double restSpeed(const BodyView<Real>& bodies, std::uint32_t row, int axis) const;
    bool leavesPartition(const BodyView<Real>& bodies, std::uint32_t row, double now,
                         double to) const;

    std::array<double, 2> gravity_;
    double restitution_;
    Real reach_ = 0;  // of the current partition

    CandidatePairs<Real> candidates_;
    std::vector<std::uint32_t> neighbourStarts_, neighbours_;
    std::vector<Event> heap_;
    std::vector<std::uint32_t> stamps_;   // events of each body so far; outdates what was found before
    std::vector<std::uint32_t> changed_;  // bodies whose events are to be found again
};

}  // namespace quadrille
