#include "app/window/plot_canvas.hpp"

#include <algorithm>

#include "app/window/theme.hpp"

namespace quadrille::app {

PlotCanvas::PlotCanvas(const char* id, float height, const std::string& widest)
    : labelWidth_(ImGui::CalcTextSize(widest.c_str()).x), list_(*ImGui::GetWindowDrawList()) {
    const ImVec2 place = ImGui::GetCursorScreenPos();
    const float margin = ImGui::GetFontSize() / 2;  // half of a number stands above the plot
    low_ = {place.x + labelWidth_ + 5, place.y + margin / 2};
    high_ = {place.x + ImGui::GetContentRegionAvail().x, place.y + height};
    ImGui::InvisibleButton(id, {high_.x - place.x, height + margin});
    list_.AddRectFilled(low_, high_, packed(theme.frame), 2);
    const ImVec2 mouse = ImGui::GetMousePos();
    if (ImGui::IsItemHovered() && mouse.x >= low_.x && mouse.x < high_.x) {
        mouse_ = (mouse.x - low_.x) / (high_.x - low_.x);
    }
}

void PlotCanvas::addLine(float share, const std::string& number) {
    const float y = high_.y - share * height();
    list_.AddLine({low_.x, y}, {high_.x, y}, packed(theme.border));
    const ImVec2 size = ImGui::CalcTextSize(number.c_str());
    list_.AddText({low_.x - 5 - size.x, y - size.y / 2}, packed(theme.faintText), number.c_str());
}

void PlotCanvas::addCaption(const std::string& text, bool right) {
    const float x = right ? high_.x - 5 - ImGui::CalcTextSize(text.c_str()).x : low_.x + 5;
    list_.AddText({x, low_.y + 2}, packed(right ? theme.faintText : theme.text), text.c_str());
}

}  // namespace quadrille::app
