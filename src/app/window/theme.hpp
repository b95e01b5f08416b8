#pragma once

#include <cstdint>
#include <span>

#include <quadrille/components.hpp>

namespace quadrille::app {

/// The colours of panels, and of what is drawn over the world.
struct Theme {
    Color ground{13, 16, 20};  ///< behind the world

    Color panel{22, 26, 31};
    Color border{56, 64, 74};
    Color frame{41, 48, 58};  ///< of what can be edited
    Color frameHovered{52, 64, 80};
    Color frameActive{60, 76, 98};
    Color popup{28, 33, 40};
    Color header{36, 56, 80};
    Color headerHovered{44, 72, 104};
    Color headerActive{50, 84, 122};
    Color button{42, 70, 102};
    Color buttonHovered{50, 86, 126};
    Color buttonActive{58, 98, 142};
    Color title{30, 46, 66};
    Color accent{88, 160, 222};

    Color text{232, 236, 240};
    Color faintText{164, 176, 190};
    Color errorText{255, 150, 128};
    Color goodText{130, 214, 150};

    Color legend{20, 24, 29, 235};  ///< behind the text of legends

    Color selection{255, 235, 130};
    Color collided{255, 120, 80};
    Color touching{200, 200, 200};
    Color arrow{190, 230, 255};
};
inline constexpr Theme theme;

/// A text and what it stands on, be it the brightest that shines through.
struct TextColors {
    const char* where;
    Color text, ground;
};
/// Every combination that the window has.
std::span<const TextColors> textColors();

/// As Dear ImGui's draw lists take it.
constexpr std::uint32_t packed(const Color& color) {
    return std::uint32_t(color.r) | std::uint32_t(color.g) << 8 | std::uint32_t(color.b) << 16 |
           std::uint32_t(color.a) << 24;
}

/// How well a text can be read, from 1 to 21, as WCAG 2 defines it: the relative luminance of the
/// lighter colour over that of the darker one.
double contrast(const Color& a, const Color& b);

}  // namespace quadrille::app
