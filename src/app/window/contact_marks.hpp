#pragma once

#include <imgui.h>
#include <optional>
#include <vector>

#include <quadrille/contact.hpp>
#include <quadrille/world.hpp>

#include "app/window/camera.hpp"
#include "app/window/legends.hpp"

namespace quadrille::app {

/// Draws contacts where the boxes meet now: the part of their sides that meets and, through its
/// middle, along each axis that the contact acts along, a line as long as the impulse: the key
/// to that, if there are any. Those of `only` alone, if there is one.
std::optional<LengthKey> drawContactMarks(ImDrawList& list, const World& world,
                                          const std::vector<Contact>& contacts,
                                          std::optional<Entity> only, const Camera& camera,
                                          const ScreenRect& view, double scale);

}  // namespace quadrille::app
