#pragma once

#include "app/window/panels.hpp"

namespace quadrille::app {

/// Draws the ways of the last seconds: of the selected body, or without one of all, below what else
/// is drawn over the world.
void showTrails(const PanelContext& context);

}  // namespace quadrille::app
