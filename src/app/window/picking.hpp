#pragma once

#include <optional>

#include <quadrille/world.hpp>

namespace quadrille::app {

/// The visible body whose box is nearest to `place`, and at most `tolerance` px away on either
/// axis; of those that contain it, the one that is drawn last.
std::optional<Entity> bodyAt(const World& world, const Vec2& place, double tolerance);

}  // namespace quadrille::app
