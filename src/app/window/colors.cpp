#include "app/window/colors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace quadrille::app {

namespace {

template <std::size_t count>
Color interpolate(const std::array<Color, count>& stops, double t) {
    const double place = std::clamp(t, 0.0, 1.0) * double(count - 1);
    const auto i = std::min(static_cast<std::size_t>(place), count - 2);
    const double f = place - double(i);
    const auto mix = [&](std::uint8_t a, std::uint8_t b) {
        return static_cast<std::uint8_t>(std::lround(a + (b - a) * f));
    };
    return {mix(stops[i].r, stops[i + 1].r), mix(stops[i].g, stops[i + 1].g),
            mix(stops[i].b, stops[i + 1].b), 255};
}

}  // namespace

// Stops of the maps "inferno", "viridis" and "plasma" of matplotlib (public domain).
Color heatColor(double t) {
    static constexpr std::array<Color, 8> inferno = {{{31, 12, 72},
                                                      {74, 12, 107},
                                                      {120, 28, 109},
                                                      {165, 44, 96},
                                                      {207, 68, 70},
                                                      {237, 105, 37},
                                                      {251, 155, 6},
                                                      {247, 209, 61}}};
    return interpolate(inferno, t);
}

Color speedColor(double t) {
    static constexpr std::array<Color, 6> viridis = {{{72, 62, 160},
                                                      {58, 108, 178},
                                                      {42, 145, 160},
                                                      {53, 183, 121},
                                                      {144, 215, 67},
                                                      {253, 231, 37}}};
    return interpolate(viridis, t);
}

Color energyColor(double t) {
    static constexpr std::array<Color, 6> ice = {{{52, 62, 120},
                                                  {54, 98, 160},
                                                  {62, 140, 178},
                                                  {110, 184, 184},
                                                  {184, 220, 190},
                                                  {255, 252, 204}}};
    return interpolate(ice, t);
}

Color sinceHitColor(double t) {
    // Its dark end is lightened, so that bodies stay visible before the dark ground.
    static constexpr std::array<Color, 6> plasma = {{{240, 249, 33},
                                                     {253, 180, 47},
                                                     {237, 121, 83},
                                                     {204, 71, 120},
                                                     {140, 52, 158},
                                                     {82, 62, 140}}};
    return interpolate(plasma, t);
}

Color cellColor(const CellCoordinates& cell) {
    std::uint64_t h = (std::uint64_t(cell.x) << 32) ^ (std::uint64_t(cell.y) << 8) ^ cell.shift;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;  // splitmix64
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    h ^= h >> 31;
    // Each channel from 95 to 254: bright enough before the dark ground.
    const auto channel = [&](int shift) {
        return static_cast<std::uint8_t>(95 + ((h >> shift) & 0xff) * 159 / 255);
    };
    return {channel(0), channel(8), channel(16), 255};
}

double heatScale(std::size_t count, std::size_t most) {
    return most == 0 ? 0 : std::sqrt(double(count) / double(most));
}

}  // namespace quadrille::app
