#pragma once

#include "app/window/camera.hpp"
#include "app/window/comparison_layout.hpp"
#include "app/window/error_history.hpp"
#include "app/window/measures.hpp"
#include "app/window/phase_history.hpp"
#include "app/window/view_state.hpp"
#include "app/window/workbench.hpp"

namespace quadrille::app {

/// What the panels show and change. They stand in a column at the left of the window; the rest of
/// it shows the world.
struct PanelContext {
    Workbench& bench;
    ViewState& view;
    const Measures& measures;
    const PhaseHistory& history;
    const ErrorHistory& errors;
    double scale;       ///< of text and panels
    int width, height;  ///< of the window, points
};

/// The part of the window that the panels leave to the world; of two that are compared, to the
/// first.
ScreenRect worldRect(const ViewState& view, double scale, int width, int height);

/// Where the timeline is shown: below the world, with the panels.
ScreenRect timelineRect(const ViewState& view, double scale, int width, int height);

/// How a comparison divides what the panels leave; only where there is one.
ComparisonLayout comparisonLayout(const ViewState& view, double scale, int width, int height);

/// Builds all panels of a picture.
void showPanels(const PanelContext& context);

// ---- their parts

/// The title of a part of the column, which a click folds; whether it is open.
bool sectionHeader(const char* label, const char* meaning);

/// Says what the item before is for, once the mouse rests on it.
void tooltip(const char* text);

void showScenePanel(const PanelContext& context);
void showRunPanel(const PanelContext& context);
void showCollisionsPanel(const PanelContext& context);
void showDisplayPanel(const PanelContext& context);
void showCountersPanel(const PanelContext& context);
void showFrameTimePanel(const PanelContext& context);
void showLoadPanel(const PanelContext& context);
void showErrorPanel(const PanelContext& context);
void showEntityWindow(const PanelContext& context);
void showHelpWindow(const PanelContext& context);
void showMessage(const PanelContext& context);

}  // namespace quadrille::app
