#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <quadrille/vec2.hpp>

#include "reference/oracle.hpp"
#include "reference/scheduler.hpp"
#include "reference/tracks.hpp"

namespace quadrille::reference {

/// The trajectories and collisions of Oracle, for Scheduler.
class TrackModel {
  public:
    using Time = double;

    TrackModel(const std::vector<Box>& boxes, const Vec2& gravity, double restitution, Ties ties);

    std::int64_t movingCount() const { return std::int64_t(moving_.size()); }
    std::int64_t staticCount() const { return std::int64_t(fixed_.size()); }
    double seconds(double time) const { return time; }

    Cell cellAtStart(std::int64_t i) const;
    std::uint32_t priority(std::int64_t i, std::int64_t j) const;
    std::optional<Hit<double>> hit(std::int64_t i, std::int64_t j, double now) const;
    std::optional<Crossing<double>> crossing(std::int64_t i, const Cell& cell, double now) const;
    std::optional<double> release(std::int64_t i, double now) const;
    bool collide(std::int64_t i, std::int64_t j, int axis, double now, const Near& near,
                 std::vector<std::int64_t>& changed);
    void letGo(std::int64_t i, double now, std::vector<std::int64_t>& changed);

    Vec2 position(std::int64_t i, double time) const;
    Vec2 velocity(std::int64_t i, double time) const;
    const Oracle::Choices& choices() const { return choices_; }

  private:
    static constexpr std::int64_t nothing = INT64_MAX;

    struct Body {
        std::array<Track, 2> track;
        Vec2 half;  ///< px
        double mass = 0;
        std::uint32_t label = 0;
        std::array<std::int64_t, 2> support{nothing, nothing};  ///< what it rests on, per axis

        bool rests(int k) const { return support[std::size_t(k)] != nothing; }

        // Collisions in the present cells of time, and the time of the last one, s.
        int atOnce = 0, deepAtOnce = 0, touching = 0, held = 0;
        double last = -1;
    };

    /// Boxes that are pushed together along an axis.
    struct Side {
        std::vector<std::int64_t> boxes;
        double mass = 0;    ///< kg
        bool held = false;  ///< by what does not move
    };
    /// How a collision is to be carried out.
    struct Manner {
        double now;
        double restitution;
        const Near& near;
    };

    /// A pair along one axis at some time, seen so that `i` is below `j`.
    struct Meeting {
        double sign;      ///< +1 if j is on the upper side, else -1
        double distance;  ///< of the centres, px, not negative
        double contact;   ///< the distance at which they touch, px
        double approach;  ///< px/s
        double pressure;  ///< the acceleration towards each other, px/s^2
        double rounding;  ///< px: a gap or a penetration up to this counts as touching
        double creep;     ///< px/s: a slower approach is none
    };

    const Body& body(std::int64_t id) const {
        return id < 0 ? fixed_[std::size_t(-1 - id)] : moving_[std::size_t(id)];
    }
    Body& moving(std::int64_t id) { return moving_[std::size_t(id)]; }

    Meeting meet(std::int64_t i, std::int64_t j, int k, double now) const;
    static bool comesToRest(const Meeting& meeting, double restitution);
    bool collides(const Meeting& meeting) const;
    bool isJammed(std::int64_t i, std::int64_t j, int axis, bool deep, double now);
    bool separatedAlready(std::int64_t i, std::int64_t j, double now);
    bool holds(std::int64_t i, int k, double direction) const;
    Side sideOf(std::int64_t i, int k, double direction, const Manner& manner) const;
    void push(int k, std::int64_t i, std::int64_t j, const Meeting& meeting, const Manner& manner,
              std::vector<std::int64_t>& changed);
    std::optional<Hit<double>> touching(std::int64_t i, std::int64_t j, double now,
                                        double until) const;

    /// What a collision of a pair along one axis does.
    enum class Outcome { Nothing, Collision, Contact };
    Outcome collideAlong(int k, std::int64_t i, std::int64_t j, const Manner& manner,
                         std::vector<std::int64_t>& changed);
    void settle(int k, std::int64_t i, std::int64_t j, const Meeting& meeting, double now,
                std::vector<std::int64_t>& changed);
    void bounceOff(int k, std::int64_t i, std::int64_t j, const Meeting& meeting, double now);
    void exchange(int k, std::int64_t i, std::int64_t j, const Meeting& meeting);
    void restOn(int k, std::int64_t i, std::int64_t support, double position, double velocity,
                double now);
    void fly(int k, std::int64_t i, double position, double velocity, double now);
    void letGoRestingOn(std::int64_t support, double now, std::vector<std::int64_t>& changed);

    std::vector<Body> moving_;
    std::vector<Body> fixed_;
    std::array<double, 2> gravity_;
    double restitution_;
    Ties ties_;
    double cellWidth_;
    std::size_t resting_ = 0;  // supports in use; saves the search for what rests on a box
    double instant_ = -1;      // s; of the deep pairs that have collided at it:
    std::set<std::pair<std::int64_t, std::int64_t>> separated_;
    Oracle::Choices choices_;
};

}  // namespace quadrille::reference
