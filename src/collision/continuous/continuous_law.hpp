#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "collision/continuous/event_loop.hpp"
#include "collision/continuous/shared_events.hpp"
#include "collision/law.hpp"
#include "collision/pairs/neighbours.hpp"
#include "collision/pairs/threads_candidate_pairs.hpp"
#include "collision/rules/paths.hpp"

namespace quadrille {

/// The law `continuous`, for paths that are straight or fall: all events of a step in the order of
/// time, found again for the bodies that an event changed (event-driven simulation of hard bodies;
/// Alder & Wainwright 1959).
///
/// Positions follow from anchors that change in events only, and an event's time from the
/// trajectories of its bodies only, so the state does not depend on dt; nor, since events are
/// carried out in an order that is complete, on who finds them.
template <class Real, class Path>
class ContinuousLaw final : public ContactLaw<Real> {
  public:
    /// `team` must outlive the law.
    ContinuousLaw(const StepSettings& settings, const ThreadTeam& team);

    void begin(const LawBodies<Real>& bodies, Step<Real>& step) override;
    std::optional<Reach<Real>> reach(const LawBodies<Real>& bodies, double now, double to) override;
    double advance(const LawBodies<Real>& bodies, const Partition<Real>& partition, double now,
                   Step<Real>& step) override;
    bool placed() const override { return placed_; }
    std::span<const ContactRecord> contacts() override { return records_; }
    std::size_t bytes() const override;

  private:
    static constexpr bool falls = Path::falls;
    using Motion = ExactMotion<Real, Path>;
    using Search = EventSearch<Real, Path>;

    struct alignas(64) Found {
        EventQueue events;
    };

    void takeOver(const LawBodies<Real>& bodies, double now);
    void takeEdits(const LawBodies<Real>& bodies, double now);
    void setOut(const LawBodies<Real>& bodies, std::uint32_t row, double now);
    void forgetMoment();
    bool coversChanged(const Motion& motion, double now, bool fresh) const;
    void survey(const LawBodies<Real>& bodies);
    template <class Function>
    double sumOver(std::size_t rows, Function&& function) const;
    double areaOf(std::size_t rows, double life) const;
    double chooseLife(std::size_t rows, double rest);
    double largestHalf(const BodyView<Real>& bodies) const;
    void noteDensity(std::size_t rows);
    std::uint64_t eventsWorthTheLife(std::size_t rows) const;
    void requireProgress(const BodyView<Real>& bodies, const PairEvent& event);
    double sharedStretch(double now, double rest);
    double gravityAlong(int axis) const { return axis == 0 ? gravityX_ : gravityY_; }
    /// A light body leaves a heavy one at up to twice the heavy one's speed.
    double gainOf() const { return uniformMass_ ? 1 : 2; }
    void findAll(const Search& search, double from, double to);
    double runEvents(const LawBodies<Real>& bodies, const Partition<Real>& partition, double now,
                     Step<Real>& step);
    double fastestAllowed() const;
    bool runShared(const LawBodies<Real>& bodies, const Search& search, const EventWindow& window,
                   double now, Step<Real>& step);
    Motion motionOf(const LawBodies<Real>& bodies) const;
    void place(const LawBodies<Real>& bodies, double t);
    bool someoneLooks(const Step<Real>& step) const;

    const ThreadTeam& team_;
    double gravityX_, gravityY_;  // px/s^2
    double restitution_;

    std::optional<std::uint64_t> revision_;  // of the bodies that all below is about
    std::uint64_t layout_ = 0;               // the same
    std::optional<double> done_;             // s; up to here events were run, if none failed
    bool placed_ = true;                     // the columns say where bodies are now
    bool uniformMass_ = true;

    // As the bodies were when the partition was asked for:
    double fastest_ = 0;                   // px/s, along an axis
    double farthest_ = 0;                  // px, from the origin along an axis; up to the horizon
    double speedSum_ = 0, squareSum_ = 0;  // over the bodies
    double sizeSum_ = 0;                   // px; a body's size is the mean of width and height
    double largest_ = 0;                   // px, half an extent, of static bodies as well
    double gravityNow_ = 0;                // px/s^2, that bodies feel that do not rest

    double partitionTime_ = 0;  // s; the partition covers the bodies from here
    double horizon_ = -1;       // to here, and all meetings up to here have been found
    SpeedBounds bounds_;        // as long as these hold
    std::vector<double> ownBounds_;
    std::vector<Real> ownReach_;
    double life_ = 0;                // s, of the last partition, if no event ends it before
    double shortestLife_ = 0;        // s, that it could have had
    double outlier_ = 0;             // times the mean speed; faster bodies have bounds of their own
    double common_ = 0;              // px/s, that the bounds of all others are for
    bool outran_ = false;            // an event made a body faster than its bound
    int editsSince_ = 0;             // partitionTime_, steps before which bodies were edited
    double density_ = 0;             // candidate pairs a px^2 around a body
    std::uint64_t eventsSince_ = 0;  // partitionTime_
    double eventRate_ = 0;           // events/s, while the partition before held
    std::uint64_t mostEvents_ = 0;   // after which the pairs are not worth their life

    ThreadsCandidatePairs<Real> candidates_;
    Neighbours neighbours_;
    PathSketches<Real, Path> sketches_;
    std::vector<std::uint32_t> stamps_;  // changes of each body so far
    std::vector<Found> found_;           // by each worker
    EventLoopState events_;
    std::unique_ptr<SharedEvents<Real, Path>> shared_;  // null where events take one thread
    std::vector<ContactRecord> records_;
    std::vector<std::uint32_t> eventsOf_;  // each body in this step; empty in a usual one
};

/// The law for a configuration: paths fall where there is gravity.
template <class Real>
std::unique_ptr<ContactLaw<Real>> makeContinuousLaw(const SimulationConfig& config,
                                                    const ThreadTeam& team);

}  // namespace quadrille
