#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <quadrille/vec2.hpp>

#include "reference/oracle.hpp"

/// How far a run is from the exact one; docs/accuracy.md says what each number means.
namespace quadrille::accuracy {

using reference::Event;

/// Collisions of two runs that are the same.
struct EventMatch {
    std::uint64_t exact = 0;     ///< collisions of the exact run
    std::uint64_t measured = 0;  ///< collisions of the measured one
    std::uint64_t matched = 0;

    /// Matched over exact; 1 if there was nothing to find.
    double recall() const;
    /// Matched over measured; 1 if nothing was reported.
    double precision() const;
    /// Harmonic mean of the two.
    double f1() const;
    /// Exact ones that the measured run does not have, and those that only it has.
    std::uint64_t missed() const { return exact - matched; }
    std::uint64_t invented() const { return measured - matched; }
    /// Measured over exact, minus 1; nothing if only the measured run has collisions.
    std::optional<double> rateBias() const;
};

/// Counts collisions of the same pair along the same axis (a corner hit is an axis of its own)
/// whose times differ by at most `tolerance` s, each matched at most once, and as many as possible.
/// Neither list has to be sorted.
EventMatch matchEvents(std::span<const Event> exact, std::span<const Event> measured,
                       double tolerance);

/// The same while two runs go on: memory is only taken for events that may still find a partner.
class EventMatcher {
  public:
    explicit EventMatcher(double tolerance) : tolerance_(tolerance) {}

    void addExact(const Event& event) { exact_.push_back(event); }
    void addMeasured(const Event& event) { measured_.push_back(event); }

    /// Says that all events before `time` have been added.
    void advance(double time);

    /// Of the events that are settled: they have a partner, or can have none any more.
    const EventMatch& match() const { return match_; }

  private:
    double tolerance_;
    std::vector<Event> exact_, measured_;  // not settled
    EventMatch match_;
};

/// Position and velocity of a moving body.
struct BodyState {
    Vec2 position{0, 0};  ///< px
    Vec2 velocity{0, 0};  ///< px/s
};

/// Quantiles by nearest rank: the smallest value that is not below the given share of all.
struct Quantiles {
    double median = 0, p99 = 0, max = 0;
};

/// All zero if there are no values.
Quantiles quantiles(std::vector<double> values);

/// Whether a component differs by more than `tolerance` px/s, or is no number.
bool velocityDiffers(const Vec2& exact, const Vec2& measured, double tolerance);

/// Bodies whose velocity differs from the exact one. Both states have the same length.
std::size_t wrongBodies(std::span<const BodyState> exact, std::span<const BodyState> measured,
                        double tolerance);

/// Distances between exact and measured positions, over `length` px.
Quantiles positionErrors(std::span<const BodyState> exact, std::span<const BodyState> measured,
                         double length);

/// Largest difference between the k-th smallest |vx| before and after, for all k, and the same for
/// |vy|; over the largest component before. 0 if nothing moves in both. Collisions of equal masses
/// permute the components, so that any difference is an error.
double speedDrift(std::span<const BodyState> before, std::span<const BodyState> after);

/// All of section 6 of the known answers, about one run.
struct ErrorMetrics {
    double horizon = 0;  ///< s that were compared
    EventMatch events;
    /// Collisions of the reference whose outcome is a rule: of bodies that others hold or that push
    /// others along (restitution below 1), and of jammed ones.
    std::uint64_t pushedCollisions = 0, jammedCollisions = 0;

    std::size_t bodies = 0;        ///< that move
    std::size_t wrongBodies = 0;   ///< at the end
    double velocityTolerance = 0;  ///< px/s; 0: any difference counts
    Quantiles positionError;       ///< at the end, over `length`
    double length = 0;             ///< px: S, the mean side of the moving bodies

    std::size_t escaped = 0;  ///< bodies outside the world at the end
    double overlapMax = 0;    ///< deepest overlap at the end of an audited step, over `length`
    double overlapMean = 0;   ///< mean over all overlapping pairs of these steps

    double energyDrift = 0;            ///< (energy - exact energy) / kinetic energy
    std::optional<double> speedDrift;  ///< where speeds are only ever exchanged
    std::optional<Vec2> wallIdentity;  ///< relative residual for x and y; see VirialBalance

    std::uint64_t auditedSteps = 0;
    std::uint64_t overlappingPairs = 0;  ///< in them, before the contacts were resolved
    std::uint64_t missedPairs = 0;       ///< of these, not shown by the broad phase

    double wrongBodyFraction() const {
        return bodies == 0 ? 0 : double(wrongBodies) / double(bodies);
    }
    /// Shown over overlapping pairs; 1 if none overlapped, nothing if nobody looked.
    std::optional<double> broadPhaseRecall() const;
};

}  // namespace quadrille::accuracy
