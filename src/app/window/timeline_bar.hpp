#pragma once

#include "app/window/panels.hpp"

namespace quadrille::app {

/// Below the world: a step back or on, playing backwards, and a slider over all steps that can be
/// shown, with the hash of the state that is.
void showTimelineBar(const PanelContext& context);

}  // namespace quadrille::app
