#include "app/window_options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/one_of.hpp"
#include "app/video_format.hpp"

namespace quadrille::app {

namespace {

constexpr int leastSide = 64, mostSide = 16384;

constexpr Named<ColorBy> allColorings[] = {
    {ColorBy::Entity, "entity", "its own"},
    {ColorBy::Speed, "speed", "speed"},
    {ColorBy::Energy, "energy", "kinetic energy"},
    {ColorBy::SinceHit, "since-hit", "time since the last hit"},
    {ColorBy::Cell, "cell", "cell of the partition"},
};

/// The number at the start of `text`, which is cut off; -1 if there is none in the valid range.
int takeSide(std::string_view& text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || value < leastSide || value > mostSide) return -1;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

std::optional<WindowSize> parseSize(std::string_view text) {
    const int width = takeSide(text);
    if (width < 0 || text.empty() || (text.front() != ',' && text.front() != 'x')) return {};
    text.remove_prefix(1);
    const int height = takeSide(text);
    if (height < 0 || !text.empty()) return {};
    return WindowSize{width, height};
}

/// Not a number if the text is none.
double parseNumber(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? value : std::nan("");
}

/// A factor from 1/64 to 64, or "max"; not a number if it is neither.
double parseSpeed(std::string_view text) {
    if (text == "max") return 0;
    const double value = parseNumber(text);
    return value >= 1.0 / 64 && value <= 64 ? value : std::nan("");
}

/// Bytes of "256MB", "1.5GB", "0"; nothing if it is no such text.
std::optional<std::uint64_t> parseBytes(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || !(value >= 0)) return std::nullopt;
    const std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
    const std::map<std::string_view, double> units = {
        {"", 1}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}};
    const auto found = units.find(unit);
    if (found == units.end() || value * found->second > 1e15) return std::nullopt;
    return static_cast<std::uint64_t>(value * found->second);
}

}  // namespace

std::span<const Named<ColorBy>> colorings() { return allColorings; }

void declareWindowOptions(CLI::App& app, WindowOptions& options) {
    const char* const group = "Window";
    const auto refuse = [](const char* option, const std::string& text, const std::string& reason) {
        throw CLI::ValidationError(option, "'" + text + "' " + reason);
    };
    app.add_flag("--offscreen", options.offscreen,
                 "Draw the window's pictures without a screen, for --screenshot and --video")
        ->group(group);
    app.add_option_function<std::string>(
           "--size,--window-size",
           [&options, refuse](const std::string& text) {
               options.size = parseSize(text);
               if (options.size) return;
               refuse("--size", text, "is not WIDTH,HEIGHT with sides from 64 to 16384");
           },
           "Size of the window (1280x720, times the scale)")
        ->type_name("W,H")
        ->group(group);
    app.add_option_function<std::string>(
           "--scale",
           [&options, refuse](const std::string& text) {
               options.scale = parseNumber(text);
               if (*options.scale >= 0.5 && *options.scale <= 4) return;
               refuse("--scale", text, "is not a number from 0.5 to 4");
           },
           "Size of text and panels (the display's; 1 with --offscreen)")
        ->type_name("FACTOR")
        ->group(group);
    app.add_flag("!--hide-panels", options.panels, "Start without the panels")->group(group);
    app.add_flag("--paused", options.paused, "Start paused")->group(group);
    app.add_option_function<std::string>(
           "--speed",
           [&options, refuse](const std::string& text) {
               options.speed = parseSpeed(text);
               if (std::isnan(*options.speed)) {
                   refuse("--speed", text, "is neither a number from 1/64 to 64 nor max");
               }
           },
           "Seconds of the simulation per second, of the video with --video, or max: a step in "
           "every picture (1; max with --offscreen and no --video)")
        ->type_name("FACTOR")
        ->group(group);
    app.add_option_function<std::vector<std::string>>(
           "--show",
           [&options](const std::vector<std::string>& names) {
               for (const std::string& name : names) {
                   options.overlays.gridlines |= name == "gridlines";
                   options.overlays.heatMap |= name == "heat-map";
                   options.overlays.contacts |= name == "contacts";
                   options.overlays.arrows |= name == "arrows";
                   options.overlays.trails |= name == "trails";
               }
           },
           "gridlines, heat-map, contacts, arrows (velocities), trails, or several of them")
        ->delimiter(',')
        ->allow_extra_args(false)  // a scene may follow
        ->check(oneOf({"gridlines", "heat-map", "contacts", "arrows", "trails"}))
        ->type_name("WHAT,...")
        ->group(group);
    app.add_option_function<std::string>(
           "--color-by",
           [&options](const std::string& name) { options.colorBy = *find(colorings(), name); },
           alternatives(colorings()) + " (" + std::string(colorings().front().name) + ")")
        ->check(oneOf(namesOf(colorings())))
        ->type_name("WHAT")
        ->group(group);
    app.add_flag("!--no-vsync", options.vsync, "Show pictures without waiting for the screen")
        ->group(group);
    app.add_option_function<std::string>(
           "--history",
           [&options, refuse](const std::string& text) {
               const auto bytes = parseBytes(text);
               if (!bytes) refuse("--history", text, "is no size such as 256MB, 1.5GB or 0");
               options.history = *bytes;
           },
           "Memory for states to go back to on the timeline; 0 keeps none (256MB)")
        ->type_name("SIZE")
        ->group(group);
    app.add_option("--screenshot", options.screenshot, "Write the last frame shown as PNG")
        ->check([](const std::string& text) {
            return text.empty() ? std::string("is empty") : std::string();
        })
        ->type_name("FILE")
        ->group(group);
    auto* const video = app.add_option("--video", options.video,
                                       "Write all that is shown as a film, with ffmpeg, or without "
                                       "it as Y4M: " +
                                           videoEndings())
                            ->check([](const std::string& text) {
                                return isVideoName(text)
                                           ? std::string()
                                           : "'" + text + "' ends in none of " + videoEndings();
                            })
                            ->type_name("FILE")
                            ->group(group);
    app.add_option("--frame-rate", options.frameRate, "Pictures per second of the film")
        ->check(CLI::Range(1, 240))
        ->type_name("N")
        ->capture_default_str()
        ->group(group)
        ->needs(video);
}

}  // namespace quadrille::app
