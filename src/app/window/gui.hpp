#pragma once

#include <SDL.h>

#include "app/window/sdl_window.hpp"

namespace quadrille::app {

/// Dear ImGui on an SDL window: one frame of panels after the other.
class Gui {
  public:
    explicit Gui(SdlWindow& window);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    void processEvent(const SDL_Event& event);
    /// Whether the panels use the mouse, or the keyboard, just now.
    bool wantsMouse() const;
    bool wantsKeyboard() const;

    /// Size of text and panels, 1 for 13 points.
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
    double scale_ = 1;
    double fontPixels_ = 0;  // of the font texture
};

}  // namespace quadrille::app
