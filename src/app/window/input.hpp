#pragma once

#include <SDL.h>
#include <span>

#include "app/window/gui.hpp"
#include "app/window/view_state.hpp"
#include "app/window/workbench.hpp"

namespace quadrille::app {

/// Mouse, keyboard and dropped files; what the panels use is theirs.
class Input {
  public:
    /// `views` are the parts of the window that show a world: one, or those of two runs.
    void handle(const SDL_Event& event, std::span<const ScreenRect> views, Gui& gui,
                Workbench& bench, ViewState& view);

  private:
    void press(const SDL_MouseButtonEvent& event);
    void release(const SDL_MouseButtonEvent& event, std::span<const ScreenRect> views,
                 Workbench& bench, const ViewState& view);

    Vec2 mouse_{0, 0};
    bool held_ = false;     // a button went down over the world
    bool dragged_ = false;  // and the mouse has moved since
    Vec2 pressedAt_{0, 0};
};

}  // namespace quadrille::app
