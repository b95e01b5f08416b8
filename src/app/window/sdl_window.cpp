#include "app/window/sdl_window.hpp"

#include <algorithm>
#include <epoxy/gl.h>

#include <quadrille/error.hpp>

namespace quadrille::app {

namespace {

[[noreturn]] void fail(const std::string& what, const std::string& reason) {
    throw Error(what + ": " + reason + "; --headless runs without a window");
}

}  // namespace

SdlWindow::Library::Library() {
    // Ctrl-C is the program's own affair.
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    // A busy or watched screen keeps its compositor and its screen saver.
    SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
#ifdef SDL_HINT_WINDOWS_DPI_SCALING
    SDL_SetHint(SDL_HINT_WINDOWS_DPI_SCALING, "1");
#endif
    SDL_SetMainReady();
    if (SDL_Init(SDL_INIT_VIDEO) != 0) fail("there is no display", SDL_GetError());
}

SdlWindow::SdlWindow(int width, int height) {
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_FLAGS, SDL_GL_CONTEXT_FORWARD_COMPATIBLE_FLAG);
    SDL_GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
    SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 0);
    window_.reset(SDL_CreateWindow(
        "collisionStress", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width, height,
        SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI));
    if (!window_) fail("a window with OpenGL cannot be opened", SDL_GetError());
    context_.reset(SDL_GL_CreateContext(window_.get()));
    if (!context_) fail("there is no OpenGL 3.3", SDL_GetError());
    if (epoxy_gl_version() < 33) fail("there is no OpenGL 3.3", "the driver gives an older one");
    renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

SdlWindow::Size SdlWindow::size() const {
    Size size{};
    SDL_GetWindowSize(window_.get(), &size.width, &size.height);
    SDL_GL_GetDrawableSize(window_.get(), &size.pixelWidth, &size.pixelHeight);
    // Some systems give a minimized window no size at all.
    for (int* side : {&size.width, &size.height, &size.pixelWidth, &size.pixelHeight}) {
        *side = std::max(*side, 1);
    }
    return size;
}

bool SdlWindow::setVsync(bool wanted) {
    SDL_GL_SetSwapInterval(wanted ? 1 : 0);
    return SDL_GL_GetSwapInterval() != 0;
}

void SdlWindow::setTitle(const std::string& title) {
    if (title == title_) return;
    title_ = title;
    SDL_SetWindowTitle(window_.get(), title.c_str());
}

}  // namespace quadrille::app
