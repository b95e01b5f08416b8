#pragma once

#include <imgui.h>
#include <optional>
#include <string>

namespace quadrille::app {

/// A plot as wide as the column of panels, with room for the numbers of its axis at the left.
class PlotCanvas {
  public:
    /// Takes the place of the next item; `height` in points. `widest` is the widest number.
    PlotCanvas(const char* id, float height, const std::string& widest);

    /// A line across the plot at a share of its height, and its number.
    void addLine(float share, const std::string& number);
    /// A text in the upper left or the upper right corner.
    void addCaption(const std::string& text, bool right = false);

    float left() const { return low_.x; }
    float right() const { return high_.x; }
    float bottom() const { return high_.y; }
    float width() const { return high_.x - low_.x; }
    float height() const { return high_.y - low_.y; }
    ImDrawList& list() const { return list_; }

    /// How far to the right the mouse is, from 0 to 1, while it is over the plot.
    std::optional<float> mouse() const { return mouse_; }

  private:
    ImVec2 low_, high_;
    float labelWidth_;
    ImDrawList& list_;
    std::optional<float> mouse_;
};

}  // namespace quadrille::app
