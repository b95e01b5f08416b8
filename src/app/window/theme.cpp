#include "app/window/theme.hpp"

#include <algorithm>
#include <cmath>

namespace quadrille::app {

namespace {

/// A colour that white shines through.
constexpr Color overWhite(const Color& color) {
    const auto mix = [&](int channel) {
        return static_cast<std::uint8_t>((channel * color.a + 255 * (255 - color.a)) / 255);
    };
    return {mix(color.r), mix(color.g), mix(color.b)};
}

constexpr TextColors combinations[] = {
    {"panel", theme.text, theme.panel},
    {"panel, labels", theme.faintText, theme.panel},
    {"panel, errors", theme.errorText, theme.panel},
    {"panel, good news", theme.goodText, theme.panel},
    {"field", theme.text, theme.frame},
    {"field, labels in plots", theme.faintText, theme.frame},
    {"field, hovered", theme.text, theme.frameHovered},
    {"field, active", theme.text, theme.frameActive},
    {"list", theme.text, theme.popup},
    {"list, labels", theme.faintText, theme.popup},
    {"section", theme.text, theme.header},
    {"section, hovered", theme.text, theme.headerHovered},
    {"section, active", theme.text, theme.headerActive},
    {"button", theme.text, theme.button},
    {"button, hovered", theme.text, theme.buttonHovered},
    {"button, active", theme.text, theme.buttonActive},
    {"title", theme.text, theme.title},
    {"legend", theme.text, overWhite(theme.legend)},
};

double luminance(const Color& color) {
    const auto linear = [](std::uint8_t channel) {
        const double c = channel / 255.0;
        return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
}

}  // namespace

std::span<const TextColors> textColors() { return combinations; }

double contrast(const Color& a, const Color& b) {
    const double first = luminance(a), second = luminance(b);
    return (std::max(first, second) + 0.05) / (std::min(first, second) + 0.05);
}

}  // namespace quadrille::app
