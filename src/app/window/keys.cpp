#include "app/window/keys.hpp"

namespace quadrille::app {

namespace {

using B = Workbench&;
using V = ViewState&;

constexpr double panPoints = 60;

template <class Partitioner>
void choose(B bench, V) {
    // A key of the partitioner that runs already must not throw its parameters away.
    if (std::holds_alternative<Partitioner>(bench.config().partitioner)) return;
    bench.setPartitioner(Partitioner{});
}

constexpr KeyCommand commands[] = {
    {SDLK_SPACE, false, "Space", "pause, go on", [](B b, V) { b.togglePause(); }},
    {SDLK_PERIOD, false, ".  N", "one step", [](B b, V) { b.singleStep(); }, true},
    {SDLK_n, false, nullptr, "", [](B b, V) { b.singleStep(); }, true},
    {SDLK_COMMA, false, ",", "one step back", [](B b, V) { b.stepBack(); }, true},
    {SDLK_b, false, "B", "backwards, forwards again", [](B b, V) { b.playBackwards(); }},
    {SDLK_END, false, "End", "to the newest step", [](B b, V) { b.toNewest(); }},
    {SDLK_PLUS, false, "+  -", "faster, slower", [](B b, V) { b.changeSpeed(true); }},
    {SDLK_EQUALS, false, nullptr, "", [](B b, V) { b.changeSpeed(true); }},
    {SDLK_KP_PLUS, false, nullptr, "", [](B b, V) { b.changeSpeed(true); }},
    {SDLK_MINUS, false, nullptr, "", [](B b, V) { b.changeSpeed(false); }},
    {SDLK_KP_MINUS, false, nullptr, "", [](B b, V) { b.changeSpeed(false); }},
    {SDLK_r, false, "R", "reset: start anew", [](B b, V) { b.reset(); }},
    {SDLK_RIGHTBRACKET, false, "[  ]", "last, next scene", [](B b, V) { b.openNext(1); }},
    {SDLK_LEFTBRACKET, false, nullptr, "", [](B b, V) { b.openNext(-1); }},
    // Where a keyboard has no brackets.
    {SDLK_PAGEDOWN, true, "Ctrl PgUp PgDn", "the same", [](B b, V) { b.openNext(1); }},
    {SDLK_PAGEUP, true, nullptr, "", [](B b, V) { b.openNext(-1); }},
    {SDLK_1, false, "1 2 3 4", "brute force, static grid, quadtree,\nsemi-static quadtree",
     choose<BruteForce>},
    {SDLK_2, false, nullptr, "", choose<StaticGrid>},
    {SDLK_3, false, nullptr, "", choose<Quadtree>},
    {SDLK_4, false, nullptr, "", choose<SemiStaticQuadtree>},
    {SDLK_l, false, "L", "next contact law", [](B b, V) { b.nextLaw(); }},
    {SDLK_t, false, "T", "next resolver", [](B b, V) { b.nextResolver(); }},
    {SDLK_g, false, "G", "gridlines", [](B, V v) { v.overlays.gridlines = !v.overlays.gridlines; }},
    {SDLK_m, false, "M", "heat map: bodies per cell",
     [](B, V v) { v.overlays.heatMap = !v.overlays.heatMap; }},
    {SDLK_c, false, "C", "contacts of the last step",
     [](B b, V v) {
         v.overlays.contacts = !v.overlays.contacts;
         b.watchContacts(v.overlays.contacts);
     }},
    {SDLK_a, false, "A", "arrows: velocities",
     [](B, V v) { v.overlays.arrows = !v.overlays.arrows; }},
    {SDLK_w, false, "W", "trails of the selected, or of all",
     [](B b, V v) {
         v.overlays.trails = !v.overlays.trails;
         b.watchTrails(v.overlays.trails);
     }},
    {SDLK_v, false, "V", "colour by entity, speed, energy,\ntime since the last hit, cell",
     [](B, V v) {
         const auto next = (static_cast<std::size_t>(v.colorBy) + 1) % colorings().size();
         v.colorBy = static_cast<ColorBy>(next);
     }},
    {SDLK_f, false, "F", "follow the selected entity", [](B b, V) { b.toggleFollow(); }},
    {SDLK_ESCAPE, false, "Esc", "close the innermost: list, help,\nselection, full screen",
     [](B b, V v) {
         if (v.help) {
             v.help = false;
         } else if (b.selected()) {
             b.select(std::nullopt);
         } else {
             v.fullScreen = false;
         }
     }},
    {SDLK_HOME, false, "Home  0", "show all", [](B, V v) { v.fit = true; }},
    {SDLK_0, false, nullptr, "", [](B, V v) { v.fit = true; }},
    {SDLK_PAGEUP, false, "PgUp PgDn", "zoom", [](B, V v) { ++v.zoomSteps; }, true},
    {SDLK_PAGEDOWN, false, nullptr, "", [](B, V v) { --v.zoomSteps; }, true},
    {SDLK_LEFT, false, "arrows", "pan",
     [](B, V v) {
         v.pan({panPoints, 0});
     },
     true},
    {SDLK_RIGHT, false, nullptr, "",
     [](B, V v) {
         v.pan({-panPoints, 0});
     },
     true},
    {SDLK_UP, false, nullptr, "",
     [](B, V v) {
         v.pan({0, panPoints});
     },
     true},
    {SDLK_DOWN, false, nullptr, "",
     [](B, V v) {
         v.pan({0, -panPoints});
     },
     true},
    {SDLK_TAB, false, "Tab", "panels", [](B, V v) { v.panels = !v.panels; }},
    {SDLK_PLUS, true, "Ctrl +  -", "larger, smaller text", [](B, V v) { ++v.scaleSteps; }},
    {SDLK_EQUALS, true, nullptr, "", [](B, V v) { ++v.scaleSteps; }},
    {SDLK_KP_PLUS, true, nullptr, "", [](B, V v) { ++v.scaleSteps; }},
    {SDLK_MINUS, true, nullptr, "", [](B, V v) { --v.scaleSteps; }},
    {SDLK_KP_MINUS, true, nullptr, "", [](B, V v) { --v.scaleSteps; }},
    {SDLK_F11, false, "F11", "full screen", [](B, V v) { v.fullScreen = !v.fullScreen; }},
    {SDLK_F12, false, "F12  P", "screenshot", [](B, V v) { v.screenshot = true; }},
    {SDLK_p, false, nullptr, "", [](B, V v) { v.screenshot = true; }},
    {SDLK_F1, false, "F1  H", "this help", [](B, V v) { v.help = !v.help; }},
    {SDLK_h, false, nullptr, "", [](B, V v) { v.help = !v.help; }},
    {SDLK_q, true, "Ctrl Q", "quit", [](B, V v) { v.quit = true; }},
};

}  // namespace

std::span<const KeyCommand> keyCommands() { return commands; }

void pressKey(const SDL_KeyboardEvent& event, Workbench& bench, ViewState& view) {
    // Other modifiers belong to the desktop. Shift is how some keyboards reach + and others.
    if ((event.keysym.mod & (KMOD_ALT | KMOD_GUI)) != 0) return;
    const bool control = (event.keysym.mod & KMOD_CTRL) != 0;
    for (const KeyCommand& command : commands) {
        if (command.key != event.keysym.sym || command.control != control) continue;
        if (event.repeat == 0 || command.repeats) command.action(bench, view);
        return;
    }
}

}  // namespace quadrille::app
