#include "app/window/legends.hpp"

#include <algorithm>

#include "app/window/theme.hpp"

namespace quadrille::app {

namespace {

constexpr float width = 210, barHeight = 9, padding = 8, gap = 6;  // points

}  // namespace

Legends::Legends(ImDrawList& list, const ScreenRect& view, double scale)
    : list_(list),
      scale_(float(scale)),
      right_(float(view.x + view.width - 10 * scale)),
      bottom_(float(view.y + view.height - 10 * scale)) {}

ImVec2 Legends::place(const std::string& title, float height) {
    const float line = ImGui::GetFontSize();
    const float pad = padding * scale_;
    const ImVec2 high(right_, bottom_);
    const ImVec2 low(right_ - width * scale_ - 2 * pad, bottom_ - height - 1.3f * line - 2 * pad);
    list_.AddRectFilled(low, high, packed(theme.legend), 4 * scale_);
    list_.AddText({low.x + pad, low.y + pad}, packed(theme.text), title.c_str());
    bottom_ = low.y - gap * scale_;
    return {low.x + pad, low.y + pad + 1.3f * line};
}

void Legends::addColors(const std::string& title, Color (*ramp)(double),
                        std::span<const Tick> ticks) {
    const float line = ImGui::GetFontSize();
    const float bar = barHeight * scale_, length = width * scale_;
    const ImVec2 low = place(title, bar + 1.2f * line);
    constexpr int pieces = 64;
    for (int i = 0; i < pieces; ++i) {
        list_.AddRectFilled({low.x + length * float(i) / pieces, low.y},
                            {low.x + length * float(i + 1) / pieces, low.y + bar},
                            packed(ramp((i + 0.5) / pieces)));
    }
    float free = low.x;  // numbers that would stand on each other are left out
    for (const Tick& tick : ticks) {
        const float textWidth = ImGui::CalcTextSize(tick.text.c_str()).x;
        const float x = low.x + float(tick.share) * length;
        const float left = std::clamp(x - textWidth / 2, low.x, low.x + length - textWidth);
        if (left < free) continue;
        list_.AddRectFilled({std::clamp(x - 0.5f, low.x, low.x + length - 1), low.y + bar},
                            {std::clamp(x + 0.5f, low.x + 1, low.x + length), low.y + bar * 1.3f},
                            packed(theme.text));
        list_.AddText({left, low.y + bar + 0.2f * line}, packed(theme.text), tick.text.c_str());
        free = left + textWidth + line / 2;
    }
}

void Legends::addLength(const LengthKey& key) {
    const float line = ImGui::GetFontSize();
    const ImVec2 low = place(key.title, line);
    const float middle = low.y + line / 2;
    const float end = low.x + float(key.points);
    list_.AddLine({low.x, middle}, {end, middle}, key.color, 2 * scale_);
    for (const float x : {low.x, end}) {
        list_.AddLine({x, middle - line / 4}, {x, middle + line / 4}, key.color, 2 * scale_);
    }
    list_.AddText({end + line / 2, low.y}, packed(theme.text), key.value.c_str());
}

}  // namespace quadrille::app
