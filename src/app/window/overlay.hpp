#pragma once

#include "app/window/body_colors.hpp"
#include "app/window/panels.hpp"

namespace quadrille::app {

/// Draws over the world, below the panels: contacts, velocities, the selected entity, and the
/// legends of all that.
void showOverlay(const PanelContext& context, const ColorScale& colors);

}  // namespace quadrille::app
