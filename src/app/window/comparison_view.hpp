#pragma once

#include "app/window/panels.hpp"

namespace quadrille::app {

/// The names above the two views of a comparison, what is selected in the second, and the strip of
/// plots over time.
void showComparison(const PanelContext& context);

/// The part of the panels that says the same in numbers; in the place of what cannot be changed.
void showComparisonPanel(const PanelContext& context);

}  // namespace quadrille::app
