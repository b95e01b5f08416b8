#pragma once

#include <cstdint>

#include <quadrille/entity.hpp>
#include <quadrille/vec2.hpp>

namespace quadrille {

/// The axes that a contact acts along; a corner hit acts along both.
enum class Axis : std::uint8_t { X = 1, Y = 2, Both = 3 };

/// A pair of bodies that touched in a step. `a` is the moving body that was created first; `b` is
/// the other moving body or a static one.
struct Contact {
    Entity a, b;
    double time = 0;  ///< s since the start of the run
    Axis axis = Axis::X;
    Vec2 normal{0, 0};         ///< from a to b; its components are -1, 0 or 1
    bool collided = false;     ///< the bodies approached and exchanged an impulse
    Vec2 impulse{0, 0};        ///< size of what was exchanged along each axis, kg px/s
    Vec2 approach{0, 0};       ///< speed of approach along each axis before it, px/s
    std::int64_t numberA = 0;  ///< place of `a` among the moving bodies, in order of creation
    std::int64_t numberB = 0;  ///< the same of `b`; a static body k is -1 - k
};

}  // namespace quadrille
