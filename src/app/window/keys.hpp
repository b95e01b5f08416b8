#pragma once

#include <SDL.h>
#include <span>

#include "app/window/view_state.hpp"
#include "app/window/workbench.hpp"

namespace quadrille::app {

/// What a key does: the one table for input and help.
struct KeyCommand {
    SDL_Keycode key;
    bool control;       ///< with Ctrl
    const char* label;  ///< as the help panel shows it; null for a second key of the line above
    const char* meaning;
    void (*action)(Workbench&, ViewState&);
    bool repeats = false;  ///< while the key is held
};

std::span<const KeyCommand> keyCommands();

/// Does what the key is for, if it is for anything.
void pressKey(const SDL_KeyboardEvent& event, Workbench& bench, ViewState& view);

}  // namespace quadrille::app
