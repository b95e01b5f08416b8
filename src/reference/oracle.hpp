#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <quadrille/vec2.hpp>

/// Event-driven references for the engine. They share nothing with it but the vector type, so that
/// an error of the engine cannot hide in both. Cost: O(log N) per event; static boxes are tried one
/// by one, so a scene should have few.
namespace quadrille::reference {

/// A box that does not rotate.
struct Box {
    Vec2 position{0, 0};    ///< centre, px
    Vec2 velocity{0, 0};    ///< px/s; ignored if static
    Vec2 size{1, 1};        ///< px
    double mass = 1;        ///< ignored if static
    bool isStatic = false;  ///< never moves
};

/// A collision. Moving boxes are counted from 0 among the moving ones, static boxes down from -1
/// among the static ones; a pair of moving boxes has i < j.
struct Event {
    double time = 0;  ///< s
    std::int64_t i = 0;
    std::int64_t j = 0;
    int axis = 0;  ///< 1 = x, 2 = y, 3 = both at once (an exact corner hit)
};

/// The reference in double precision: unequal sizes and masses, static boxes, uniform gravity,
/// restitution.
///
/// Every axis of a box follows x = a + v (t - t_a) + g (t - t_a)^2/2, whose anchor is changed by
/// collisions only. Equal masses at restitution 1 exchange their trajectories, offset by the
/// distance of contact, and a hit on a static box without gravity mirrors the trajectory; so boxes
/// on a lattice keep exact anchors for ever, and each event time is rounded once (docs:
/// accuracy.md, section 1). All other collisions anchor both boxes anew, with the usual rounding.
///
/// The rules, where mathematics leaves a choice:
/// - Edges that slide along each other (gap exactly 0, no approach) do not collide.
/// - Both axes reached at the same double: a corner hit, both axes are resolved.
/// - Boxes that overlap, be it from the start or by rounding, count as touching on their axis of
///   least penetration (ties: x) and collide only if they approach on it (Bannerman et al.,
///   arXiv:1211.6718). At equal centres the box with the greater id counts as the upper one. If
///   both penetrations are mere rounding, it is a corner: both axes, or none.
/// - Simultaneous events fire in the order of their ids (i, j); what a collision sets off at the
///   same instant is queued in the same order. So chains and cradles resolve pair by pair.
///   Where a box meets two others at one instant and not in a row (it lands on two that lie side by
///   side, or touches a corner as well), the mathematical motion has no unique continuation: the
///   order of ids is then a choice, and reversing all velocities need not return to the start.
/// - A rebound slower than `restSpeed` is none if restitution < 1 or if gravity presses the pair
///   together: two free boxes go on with their common velocity; a box on a static or resting box
///   rests there, without acceleration, until something hits it or its support, or it slides off.
///   Contacts that touch and approach slower than `restSpeed` are not in events().
/// - With restitution < 1, a pair that touches and approaches slower than `creepSpeed` is left
///   alone.
class Oracle {
  public:
    static constexpr double restSpeed = 1e-6;    ///< px/s
    static constexpr double creepSpeed = 1e-12;  ///< px/s

    /// Throws std::invalid_argument, naming the box, if a value is not finite, a size or mass not
    /// positive, or restitution outside [0, 1].
    explicit Oracle(std::vector<Box> boxes, const Vec2& gravity = {0, 0}, double restitution = 1);
    ~Oracle();
    Oracle(Oracle&&) noexcept;
    Oracle& operator=(Oracle&&) noexcept;

    /// Goes on to `time` (s, not before time()), events at `time` included. May be called in
    /// slices; they do not change the result. Throws std::runtime_error if events pile up without
    /// end at one instant, std::invalid_argument if `time` lies in the past.
    void runUntil(double time);

    double time() const;  ///< s

    /// All boxes, in the order given, at time().
    std::vector<Box> state() const;

    /// All collisions up to time(), in the order in which they were resolved.
    const std::vector<Event>& events() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace quadrille::reference
