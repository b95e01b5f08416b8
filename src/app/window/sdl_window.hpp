#pragma once

#include <SDL.h>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>

#include "app/window_options.hpp"

namespace quadrille::app {

/// An SDL window with an OpenGL 3.3 core context.
class SdlWindow {
  public:
    /// The size of the window in points, and of its framebuffer in pixels.
    struct Size {
        int width, height, pixelWidth, pixelHeight;
        double pixelRatio() const { return double(pixelWidth) / double(width); }
    };

    /// `offscreen` draws the same pictures and shows them nowhere. Without a `scale`, that of the
    /// display is taken; without a size, 1280 x 720 of its units. Throws Error, with a hint at
    /// --headless, where there is no OpenGL 3.3 or, unless offscreen, no display.
    SdlWindow(std::optional<WindowSize> size, std::optional<double> scale, bool offscreen);

    SDL_Window* handle() const { return window_.get(); }
    SDL_GLContext context() const { return context_.get(); }
    Size size() const;
    /// How large text is to be, 1 where the desktop wants it as usual.
    double scale() const { return scale_; }
    /// The driver's name for what draws.
    const std::string& renderer() const { return renderer_; }

    /// Asks that pictures wait for the screen, or do not; says what the driver really does.
    bool setVsync(bool wanted);
    /// The whole screen, or a window again; whether it could be done.
    bool setFullScreen(bool wanted);
    void setTitle(const std::string& title);
    void present();

  private:
    struct Library {
        explicit Library(bool offscreen);
        ~Library() { SDL_Quit(); }
    };
    struct DestroyWindow {
        void operator()(SDL_Window* window) const { SDL_DestroyWindow(window); }
    };
    struct DeleteContext {
        void operator()(void* context) const { SDL_GL_DeleteContext(context); }
    };

    Library library_;
    bool offscreen_;
    double scale_ = 1;
    std::unique_ptr<SDL_Window, DestroyWindow> window_;
    std::unique_ptr<std::remove_pointer_t<SDL_GLContext>, DeleteContext> context_;
    std::string renderer_, title_;
};

}  // namespace quadrille::app
