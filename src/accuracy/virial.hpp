#pragma once

#include <vector>

#include <quadrille/contact.hpp>
#include <quadrille/vec2.hpp>
#include <quadrille/world.hpp>

namespace quadrille::accuracy {

/// The wall identity of a run without gravity and with restitution 1, in the form that holds for
/// any sizes, masses, static boxes and any span of time (virial theorem of hard bodies). For each
/// axis, with G = sum m x v,
///
///     G(end) - G(start) = integral of sum m v^2 dt + sum over impulses J of J_i x_i + J_j x_j,
///
/// where a pair that collides is taken to stand at the distance of contact. For equal squares
/// between four walls, and over a long time, it says: mean force on the two x walls times (Lx - S)
/// = sum m vx^2 + sum over pair hits of m |dvx| S / T (known answers, section 1). A law breaks it
/// where it resolves contacts too deep, at the wrong time, or with impulses that do not add up.
class VirialBalance {
  public:
    /// Starts with the world's present state. Bodies must not be added or removed from then on.
    explicit VirialBalance(const World& world);

    /// Adds a collision of the step that is under way; in the order in which they were resolved.
    void collide(const Contact& contact);

    /// Ends a step of `dt` s.
    void finishStep(const World& world, double dt);

    /// (Left side - right side) / integral of sum m v^2 dt, for x and y; 0 for an axis without
    /// motion.
    Vec2 residual() const;

  private:
    struct Body {
        Vec2 half{0, 0};      ///< px
        double mass = 0;      ///< of moving bodies
        Vec2 position{0, 0};  ///< px, of static bodies
    };

    void read(const World& world);

    std::vector<Body> moving_, fixed_;
    std::vector<Vec2> velocities_;  // between the collisions of a step
    Vec2 virialStart_{0, 0}, virialNow_{0, 0};
    Vec2 twiceKinetic_{0, 0};
    Vec2 motion_{0, 0};    // integral of sum m v^2 dt
    Vec2 impulses_{0, 0};  // sum of J x
};

}  // namespace quadrille::accuracy
