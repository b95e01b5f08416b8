#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <quadrille/components.hpp>
#include <quadrille/vec2.hpp>
#include <quadrille/world.hpp>

namespace quadrille {

/// Makes bodies of one kind; what a scene needs to turn an entry into entities.
struct BodyMaker {
    World& world;
    bool renderers;

    Entity make(const Transform& transform, const BoxCollider& collider, const PhysicsBody& body,
                const Color& color) const;
};

/// A group of bodies that are placed by a pattern.
struct SpawnGroup {
    enum class Pattern { Lattice, Uniform };

    Pattern pattern = Pattern::Lattice;
    std::uint64_t count = 0;
    std::optional<std::pair<Vec2, Vec2>> region;  ///< low and high corner, px
    Vec2 size{1, 1};                              ///< px
    std::optional<Vec2> sides;  ///< squares with sides from x to y, density ~ 1 / side^2
    double mass = 1;
    std::optional<double> density;  ///< mass per px^2, instead of `mass`
    Vec2 speed{0, 0};   ///< each component: random sign x uniform integer in [x, y], px/s
    double jitter = 0;  ///< lattice places are moved by up to this on each axis, px
    Color color{};
};

/// Makes the group's bodies with numbers from the world's random generator. A group without a
/// region fills the `room` between the walls, which is centred on the origin.
void spawn(const SpawnGroup& group, const Vec2& room, const BodyMaker& maker);

}  // namespace quadrille
