#include "app/window/input.hpp"

#include <cmath>

#include "app/window/keys.hpp"
#include "app/window/picking.hpp"

namespace quadrille::app {

namespace {

/// A click that moves no farther than this is no drag, points.
constexpr double clickPoints = 3;
/// Bodies may be this far from where a click points, points.
constexpr double pickPoints = 4;
constexpr double wheelFactor = 1.15;

/// The number of the view at a place, or that of all views if there is none.
std::size_t viewAt(std::span<const ScreenRect> views, const Vec2& place) {
    std::size_t i = 0;
    while (i < views.size() && !views[i].contains(place)) ++i;
    return i;
}

}  // namespace

void Input::press(const SDL_MouseButtonEvent& event) {
    held_ = true;
    dragged_ = false;
    pressedAt_ = Vec2(event.x, event.y);
}

void Input::release(const SDL_MouseButtonEvent& event, std::span<const ScreenRect> views,
                    Workbench& bench, const ViewState& view) {
    const bool click = held_ && !dragged_ && event.button == SDL_BUTTON_LEFT;
    held_ = false;
    const std::size_t run = viewAt(views, pressedAt_);
    if (!click || run == views.size()) return;
    bench.select(bodyAt(bench.world(run), view.camera.toWorld(Vec2(event.x, event.y), views[run]),
                        pickPoints / view.camera.zoom()));
}

void Input::handle(const SDL_Event& event, std::span<const ScreenRect> views, Gui& gui,
                   Workbench& bench, ViewState& view) {
    switch (event.type) {
        case SDL_QUIT:
            view.quit = true;
            break;
        case SDL_KEYDOWN:
            // A list that is open is the innermost thing there is.
            if (event.key.keysym.sym == SDLK_ESCAPE && gui.closePopup()) break;
            if (!gui.wantsKeyboard()) pressKey(event.key, bench, view);
            break;
        case SDL_MOUSEBUTTONDOWN:
            if (!gui.wantsMouse() &&
                viewAt(views, Vec2(event.button.x, event.button.y)) < views.size()) {
                press(event.button);
            }
            break;
        case SDL_MOUSEBUTTONUP:
            release(event.button, views, bench, view);
            break;
        case SDL_MOUSEMOTION:
            mouse_ = Vec2(event.motion.x, event.motion.y);
            if (!held_) break;
            if (!dragged_ && (mouse_ - pressedAt_).cwiseAbs().maxCoeff() > clickPoints) {
                dragged_ = true;
                view.pan(mouse_ - pressedAt_);
            } else if (dragged_) {
                view.pan(Vec2(event.motion.xrel, event.motion.yrel));
            }
            break;
        case SDL_MOUSEWHEEL: {
            const std::size_t under = viewAt(views, mouse_);
            if (gui.wantsMouse() || under == views.size()) break;
            view.zoomAt(mouse_, std::pow(wheelFactor, double(event.wheel.preciseY)), views[under]);
            break;
        }
        case SDL_DROPFILE:
            bench.open(event.drop.file);
            SDL_free(event.drop.file);
            break;
        default:
            break;
    }
}

}  // namespace quadrille::app
