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
    Vec2 position{0, 0};      ///< centre, px
    Vec2 velocity{0, 0};      ///< px/s; ignored if static
    Vec2 size{1, 1};          ///< px
    double mass = 1;          ///< ignored if static
    bool isStatic = false;    ///< never moves
    std::uint32_t label = 0;  ///< for Ties::ByLabels
};

/// Which of several events at one instant is first: the one with the lower ids (i, j), or with the
/// lower hash of its boxes' labels: the upper half of splitmix64's finaliser of (label_i << 32 |
/// label_j). A row of ids would be gone through from one end.
enum class Ties { ByIds, ByLabels };

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
/// - Edges that slide along each other (gap exactly 0, no approach) do not collide; under gravity,
///   nor do those of boxes that touch and keep their distance.
/// - Both axes reached at the same double: a corner hit, both axes are resolved.
/// - Boxes that overlap, be it from the start or by rounding, count as touching on their axis of
///   least penetration (ties: x) and collide only if they approach on it (Bannerman et al.,
///   arXiv:1211.6718). At equal centres the box with the greater id counts as the upper one. If
///   both penetrations are mere rounding, it is a corner: both axes, or none. Deep inside each
///   other and at restitution 1, a pair collides once at any instant.
/// - Boxes touch whose distance differs from that of contact by at most `touchDistance` of it.
/// - Simultaneous events fire in the order of Ties; what a collision sets off at the same instant
///   is queued in the same order. So chains and cradles resolve pair by pair.
///   Where a box meets two others at one instant and not in a row (it lands on two that lie side by
///   side, or touches a corner as well), the mathematical motion has no unique continuation: the
///   order is then a choice, and reversing all velocities need not return to the start.
/// - A box that gravity presses onto a static or resting box, and whose rebound would not leave the
///   touching distance, rests there, without acceleration, until something hits it or its support,
///   or it slides off.
/// - With restitution < 1, boxes that touch and move together collide as one (Moreau: simultaneous
///   impacts). What is pushed against a static box, or against what it rests on, is held, and what
///   hits it rebounds as from a static box. A rebound slower than `restSpeed` is none: both
///   sides go on with their common velocity. Boxes that approach slower than `creepSpeed` do not
///   collide. Contacts slower than `restSpeed` are not in events().
/// - A box that collides over `mostHeld` times at one instant with static boxes, and with no other
///   in between, exactly fits between them: it loses what it collides with.
/// - A box that collides over `mostAtOnce` times within 2^-30 s, or, at restitution 1, while it
///   touches within 2^-15 s, is jammed: it loses what it collides with, too. Moving boxes that are
///   deep inside each other, one of them over `mostDeepAtOnce` times at once, let each other pass.
class Oracle {
  public:
    static constexpr double touchDistance = 1e-9;  ///< of the distance of contact
    static constexpr double restSpeed = 1e-6;      ///< px/s
    static constexpr double creepSpeed = 1e-9;     ///< px/s
    static constexpr int mostHeld = 8;
    static constexpr int mostAtOnce = 1000;
    static constexpr int mostDeepAtOnce = 64;

    /// Throws std::invalid_argument, naming the box, if a value is not finite, a size or mass not
    /// positive, or restitution outside [0, 1].
    explicit Oracle(std::vector<Box> boxes, const Vec2& gravity = {0, 0}, double restitution = 1,
                    Ties ties = Ties::ByIds);
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

    /// How often up to time() the outcome was one of the rules above that a model of rigid boxes
    /// leaves open, and not the mechanics of two boxes.
    struct Choices {
        std::uint64_t pushed = 0;  ///< collisions in which others were pushed, or held a box
        std::uint64_t jammed = 0;  ///< collisions of boxes that were jammed
    };
    const Choices& choices() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace quadrille::reference
