#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <quadrille/bodies.hpp>
#include <quadrille/simulation.hpp>

#include "collision/candidate_pairs.hpp"
#include "collision/event_queue.hpp"
#include "collision/neighbours.hpp"
#include "collision/partitioner.hpp"
#include "collision/resolver.hpp"
#include "collision/trajectory.hpp"

namespace quadrille {

/// The law `continuous`: all events of a step in the order of time, found again for the bodies that
/// an event changed (event-driven simulation of hard bodies; Alder & Wainwright 1959).
template <class Real>
class ContinuousLaw {
  public:
    virtual ~ContinuousLaw() = default;

    /// Anchors the bodies that have no anchor yet: all of them at first, later those that were
    /// created or edited from outside. Must be called at the start of each step.
    virtual void anchor(const BodyView<Real>& bodies, double now) = 0;

    /// How far a body may move between two times, along either axis, unless an event makes it
    /// faster than every body is now.
    virtual Real reach(const BodyView<Real>& bodies, double from, double to) = 0;

    /// Runs the events from `from` to `to`, the positions being those at `from`, and the partition
    /// one that covers `reach`. Returns `to`, or the time of an event that made a body too fast for
    /// the partition; then positions are to be placed there, and the call repeated with a new one.
    virtual double advance(const BodyView<Real>& bodies, const Partition<Real>& partition,
                           Real reach, double from, double to, std::vector<ContactRecord>* records,
                           ResolveCounts& counts) = 0;

    /// Writes the positions, and under gravity the velocities, of all bodies at time t. Returns
    /// whether they are finite.
    virtual bool place(const BodyView<Real>& bodies, double t) const = 0;

    /// Bytes of work space.
    virtual std::size_t bytes() const = 0;
};

/// Throws NotAvailable if this version does not run the law as the configuration asks.
template <class Real>
std::unique_ptr<ContinuousLaw<Real>> makeContinuousLaw(const SimulationConfig& config);

/// The law `continuous` on one core, for paths that are straight or fall.
///
/// Positions follow from anchors that change in events only, and an event's time from the
/// trajectories of its bodies only, so the state does not depend on dt. Equal masses that collide
/// elastically exchange trajectories, shifted by the distance of their centres: no rounding at all
/// where sizes and anchors lie on a lattice of doubles.
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
class SequentialContinuous final : public ContinuousLaw<Real> {
  public:
    explicit SequentialContinuous(const SimulationConfig& config)
        : gravity_{config.gravity.x(), config.gravity.y()}, restitution_(config.restitution) {}

    void anchor(const BodyView<Real>& bodies, double now) override;
    Real reach(const BodyView<Real>& bodies, double from, double to) override;
    double advance(const BodyView<Real>& bodies, const Partition<Real>& partition, Real reach,
                   double from, double to, std::vector<ContactRecord>* records,
                   ResolveCounts& counts) override;
    bool place(const BodyView<Real>& bodies, double t) const override;
    std::size_t bytes() const override;

  private:
    static constexpr bool falls = Path::falls;

    struct Paths {
        std::array<Path, 2> along;
    };

    // ---- trajectories
    Path path(const BodyView<Real>& bodies, std::uint32_t body, int axis) const;
    Paths paths(const BodyView<Real>& bodies, std::uint32_t body) const;
    double reachOf(const BodyView<Real>& bodies, std::uint32_t a, std::uint32_t b, int axis) const;
    void set(const BodyView<Real>& bodies, std::uint32_t row, int axis, double anchor,
             double velocity, double time);
    void survey(const BodyView<Real>& bodies);
    bool leavesPartition(const BodyView<Real>& bodies, std::uint32_t row, double now,
                         double to) const;

    // ---- finding events
    double slack(int axis, double position, double u, double h, double to) const;
    void find(const BodyView<Real>& bodies, std::uint32_t row, const Paths& own, std::uint32_t b,
              const Paths& other, double from, double to, bool afterEvent);
    void findOverlap(const BodyView<Real>& bodies, PairEvent event, double until, double from,
                     double to, bool afterEvent);
    void findRest(const BodyView<Real>& bodies, PairEvent event, double from, double to,
                  bool afterEvent);
    void findFor(const BodyView<Real>& bodies, std::uint32_t row, double now, double to);
    void findAll(const BodyView<Real>& bodies, double from, double to);

    // ---- bodies at rest
    bool rests(const BodyView<Real>& bodies, std::uint32_t body, int axis) const;
    void setRests(const BodyView<Real>& bodies, std::uint32_t row, int axis, bool rests);
    bool holds(const BodyView<Real>& bodies, std::uint32_t body, int axis) const;
    double rounding(const Path& a, const Path& b, double reach, double now) const;
    bool comesToRest(double closing, double pressure, double rounding) const;
    double restsUntil(const BodyView<Real>& bodies, std::uint32_t upper, std::uint32_t lower,
                      int axis, double now) const;
    bool supported(const BodyView<Real>& bodies, std::uint32_t row, int axis, double now) const;
    bool release(const BodyView<Real>& bodies, std::uint32_t row, int axis, double now);
    void releaseFromChanged(const BodyView<Real>& bodies, double now);

    // ---- carrying events out
    enum class Outcome : std::uint8_t { Nothing, Touch, Collision };

    /// Bodies that are pushed together.
    struct Group {
        std::vector<std::uint32_t> rows;
        double mass = 0;
        bool held = false;
    };

    bool isCurrent(const PairEvent& event) const;
    bool separatedAlready(const PairEvent& event);
    void changed(std::uint32_t row);
    bool resolve(const BodyView<Real>& bodies, const PairEvent& event, ContactRecord& record);
    Outcome collide(const BodyView<Real>& bodies, const PairEvent& event, int axis, double sense);
    void bounceOff(const BodyView<Real>& bodies, const PairEvent& event, std::uint32_t row,
                   std::uint32_t off, int axis, double sense);
    double surfaceFor(const BodyView<Real>& bodies, const PairEvent& event, std::uint32_t row,
                      std::uint32_t other, int axis, double sense) const;
    void exchange(const BodyView<Real>& bodies, const PairEvent& event, int axis, double sense);
    double creep(double va, double vb) const;
    void gather(const BodyView<Real>& bodies, std::uint32_t row, int axis, double sense, double now,
                Group& group);
    void move(const BodyView<Real>& bodies, const Group& group, int axis, double velocity,
              double now);
    void collideGroups(const BodyView<Real>& bodies, const PairEvent& event, int axis,
                       double sense);

    std::array<double, 2> gravity_;  // px/s^2
    double restitution_;

    std::optional<std::uint64_t> revision_;  // of the bodies that all below is about
    bool surveyed_ = false;                  // whether these two are bounds:
    double fastest_ = 0;                     // px/s, along an axis
    double farthest_ = 0;                    // px, from the origin along an axis
    Real reach_ = 0;                         // of the current partition
    double horizon_ = -1;                    // s; all meetings up to here have been found

    CandidatePairs<Real> candidates_;
    Neighbours neighbours_;
    EventQueue events_;
    std::vector<std::uint32_t> stamps_;   // changes of each body so far
    std::vector<std::uint32_t> changed_;  // bodies whose events are to be found again
    // Overlapping pairs that collided at the present instant.
    double instant_ = -1;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> separated_;
    Group groupA_, groupB_;
    std::vector<std::uint32_t> groupChanged_;
    std::vector<std::uint64_t> gathered_;  // by which call of gather() a body was gathered last
    std::uint64_t gathering_ = 0;
};

}  // namespace quadrille
