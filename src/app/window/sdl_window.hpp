#pragma once

#include <SDL.h>
#include <memory>
#include <string>
#include <type_traits>

namespace quadrille::app {

/// An SDL window with an OpenGL 3.3 core context.
class SdlWindow {
  public:
    /// The size of the window in points, and of its framebuffer in pixels.
    struct Size {
        int width, height, pixelWidth, pixelHeight;
        double pixelRatio() const { return double(pixelWidth) / double(width); }
    };

    /// `offscreen` draws the same pictures and shows them nowhere. Throws Error, with a hint at
    /// --headless, where there is no OpenGL 3.3 or, unless offscreen, no display.
    SdlWindow(int width, int height, bool offscreen);

    SDL_Window* handle() const { return window_.get(); }
    SDL_GLContext context() const { return context_.get(); }
    Size size() const;
    /// The driver's name for what draws.
    const std::string& renderer() const { return renderer_; }

    /// Asks that pictures wait for the screen, or do not; says what the driver really does.
    bool setVsync(bool wanted);
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
    std::unique_ptr<SDL_Window, DestroyWindow> window_;
    std::unique_ptr<std::remove_pointer_t<SDL_GLContext>, DeleteContext> context_;
    std::string renderer_, title_;
};

}  // namespace quadrille::app
