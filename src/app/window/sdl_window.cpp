#include "app/window/sdl_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <epoxy/gl.h>
#include <string_view>

#include <quadrille/error.hpp>

#include "app/window/desktop_resolution.hpp"

namespace quadrille::app {

namespace {

[[noreturn]] void fail(const std::string& what, const std::string& reason) {
    throw Error(what + ": " + reason +
                "; --headless runs without pictures, --offscreen draws them without a screen");
}

/// The drivers of SDL that show nothing, the first of which draws.
constexpr std::array<std::string_view, 3> screenless = {"offscreen", "dummy", "evdev"};

/// SDL takes such a driver by itself where it finds no display.
void requireScreen() {
    const std::string driver = SDL_GetCurrentVideoDriver();
    if (std::find(screenless.begin(), screenless.end(), driver) == screenless.end()) return;
    SDL_Quit();
    const char* const display = std::getenv("DISPLAY");
    const std::string asked =
        display != nullptr ? ", and DISPLAY is '" + std::string(display) + "'" : std::string();
    fail("there is no display",
         "only SDL's driver '" + driver + "' can run, which shows nothing" + asked);
}

/// Where a point of SDL is a pixel of the screen, as on X11, the desktop says by "Xft.dpi" how
/// large text is to be; elsewhere a point is as large as it should be. A step of a quarter is as
/// fine as text needs.
double displayScale() {
    const char* const driver = SDL_GetCurrentVideoDriver();
    if (driver == nullptr || std::string_view(driver) != "x11") return 1;
    return std::clamp(std::floor(desktopDotsPerInch() / 96 * 4 + 0.1) / 4, 1.0, 3.0);
}

/// What a window has that nobody asked to be larger or smaller: no more than the display has room
/// for.
WindowSize usualSize(double scale, bool offscreen) {
    WindowSize size{int(std::lround(1280 * scale)), int(std::lround(720 * scale))};
    SDL_Rect room{};
    if (!offscreen && SDL_GetDisplayUsableBounds(0, &room) == 0) {
        size = {std::min(size.width, room.w), std::min(size.height, room.h)};
    }
    return size;
}

}  // namespace

SdlWindow::Library::Library(bool offscreen) {
    // Ctrl-C is the program's own affair.
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    // A busy or watched screen keeps its compositor and its screen saver.
    SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "1");
#ifdef SDL_HINT_WINDOWS_DPI_SCALING
    SDL_SetHint(SDL_HINT_WINDOWS_DPI_SCALING, "1");
#endif
    SDL_SetMainReady();
    if (offscreen) {
        SDL_SetHintWithPriority(SDL_HINT_VIDEODRIVER, screenless.front().data(), SDL_HINT_OVERRIDE);
    }
    if (SDL_Init(SDL_INIT_VIDEO) != 0) {
        fail(offscreen ? "pictures cannot be drawn without a screen" : "there is no display",
             SDL_GetError());
    }
    if (!offscreen) requireScreen();
}

SdlWindow::SdlWindow(std::optional<WindowSize> asked, std::optional<double> scale, bool offscreen)
    : library_(offscreen), offscreen_(offscreen), scale_(scale ? *scale : displayScale()) {
    const WindowSize size = asked ? *asked : usualSize(scale_, offscreen);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_FLAGS, SDL_GL_CONTEXT_FORWARD_COMPATIBLE_FLAG);
    SDL_GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
    SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 0);
    SDL_GL_SetAttribute(SDL_GL_STENCIL_SIZE, 8);  // counts the boxes over a pixel
    window_.reset(SDL_CreateWindow(
        "collisionStress", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, size.width, size.height,
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
    if (offscreen_) return false;
    SDL_GL_SetSwapInterval(wanted ? 1 : 0);
    return SDL_GL_GetSwapInterval() != 0;
}

bool SdlWindow::setFullScreen(bool wanted) {
    return SDL_SetWindowFullscreen(window_.get(), wanted ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0) == 0;
}

void SdlWindow::present() {
    if (!offscreen_) return SDL_GL_SwapWindow(window_.get());
    // Nothing is swapped here, so the driver would keep the commands of every picture.
    glFinish();
}

void SdlWindow::setTitle(const std::string& title) {
    if (title == title_) return;
    title_ = title;
    SDL_SetWindowTitle(window_.get(), title.c_str());
}

}  // namespace quadrille::app
