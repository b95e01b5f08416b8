#pragma once

#include <imgui.h>
#include <optional>

#include <quadrille/world.hpp>

#include "app/window/camera.hpp"
#include "app/window/legends.hpp"

namespace quadrille::app {

/// Draws the velocities of the moving bodies in view as arrows: of all, or where they are crowded
/// of as many as have room. The longest stands for a round number that no body in
/// view is faster than: the key to them, if there
/// are any.
std::optional<LengthKey> drawVelocityArrows(ImDrawList& list, const World& world,
                                            const Camera& camera, const ScreenRect& view,
                                            double scale);

}  // namespace quadrille::app
