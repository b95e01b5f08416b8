#pragma once

#include <SDL.h>
#include <string>

#include "app/window/sdl_window.hpp"

namespace quadrille::app {

/// Dear ImGui on an SDL window: one frame of panels after the other.
class Gui {
  public:
    /// `scale` is what `scale()` says, until it is changed.
    Gui(SdlWindow& window, double scale);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    void processEvent(const SDL_Event& event);
    /// Whether the panels use the mouse, or the keyboard, just now.
    bool wantsMouse() const;
    bool wantsKeyboard() const;

    /// Closes the innermost list or popup that is open; whether there was one.
    bool closePopup();

    /// Size of text and panels: 1 for text that is 15 points high.
    double scale() const { return scale_; }
    /// The next larger or smaller size.
    void changeScale(bool larger);

    void beginFrame();
    void endFrame();
    /// Draws what was built between the two.
    void draw();

  private:
    void applyScale();

    SdlWindow& window_;
    double scale_;
    std::string font_;       // a file, or empty for the built-in one
    double fontPixels_ = 0;  // of the font texture
};

}  // namespace quadrille::app
