#pragma once

#include <cstdint>

#include <quadrille/vec2.hpp>

namespace quadrille {

/// Where an entity's centre is, in px.
struct Transform {
    Vec2 position{0, 0};
};

/// An axis-aligned box around the entity's position; width and height in px, both positive.
struct BoxCollider {
    Vec2 size{1, 1};
};

/// What makes a collider move. A static body has infinite mass and no velocity.
struct PhysicsBody {
    Vec2 velocity{0, 0};    ///< px/s
    double mass = 1;        ///< positive; a static body keeps it for when it moves (1 if it is not)
    bool isStatic = false;  ///< never moves
};

/// 8 bits a channel.
struct Color {
    std::uint8_t r = 255, g = 255, b = 255, a = 255;

    friend bool operator==(const Color&, const Color&) = default;
};

/// Lets an observer draw the entity's box; an entity without one is not drawn.
struct RectangleRenderer {
    Color color;
};

}  // namespace quadrille
