#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "reference/oracle.hpp"
#include "reference/rational.hpp"
#include "reference/scheduler.hpp"

namespace quadrille::reference {

/// The trajectories and collisions of LatticeOracle, for Scheduler. Positions are integers in units
/// of 2^positionExponent px, velocities in units of 2^velocityExponent px/s, and times quotients in
/// the unit that follows.
class LatticeModel {
  public:
    using Time = Rational;

    explicit LatticeModel(const std::vector<Box>& boxes);

    std::int64_t movingCount() const { return std::int64_t(moving_.size()); }
    std::int64_t staticCount() const { return std::int64_t(fixed_.size()); }
    double seconds(const Rational& time) const { return nearestDouble(time, timeExponent()); }

    Cell cellAtStart(std::int64_t i) const;
    std::optional<Hit<Rational>> hit(std::int64_t i, std::int64_t j, const Rational& now) const;
    std::optional<Crossing<Rational>> crossing(std::int64_t i, const Cell& cell,
                                               const Rational& now) const;
    std::optional<Rational> release(std::int64_t, const Rational&) const { return std::nullopt; }
    bool collide(std::int64_t i, std::int64_t j, int axis, const Rational& now, const Near&,
                 std::vector<std::int64_t>& changed);
    std::uint32_t priority(std::int64_t, std::int64_t) const { return 0; }
    void letGo(std::int64_t, const Rational&, std::vector<std::int64_t>&) {}

    /// A double as a time. Throws std::overflow_error if it does not fit.
    Rational timeOf(double seconds) const;

    /// The double nearest to the coordinate at a time; k = 0: x, 1: y.
    double position(std::int64_t i, int k, double seconds) const;
    double velocity(std::int64_t i, int k) const;

  private:
    struct Line {
        std::int64_t a = 0;  ///< position at time 0, if it had always moved like now
        std::int64_t v = 0;
    };
    struct Body {
        std::array<Line, 2> line;
        std::array<std::int64_t, 2> half{};
    };

    const Body& body(std::int64_t id) const {
        return id < 0 ? fixed_[std::size_t(-1 - id)] : moving_[std::size_t(id)];
    }
    int timeExponent() const { return positionExponent_ - velocityExponent_; }
    void refuseOverlap() const;

    int positionExponent_ = 0;
    int velocityExponent_ = 0;
    std::int64_t cellWidth_ = 1;
    std::vector<Body> moving_;
    std::vector<Body> fixed_;
};

}  // namespace quadrille::reference
