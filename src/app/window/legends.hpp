#pragma once

#include <imgui.h>
#include <span>
#include <string>

#include <quadrille/components.hpp>

#include "app/window/camera.hpp"

namespace quadrille::app {

/// What a length on the screen stands for.
struct LengthKey {
    std::string title;
    ImU32 color;
    double points;
    std::string value;
};

/// What the colours, arrows and marks of the world stand for, one below the other in the lower
/// right corner of the view.
class Legends {
  public:
    struct Tick {
        double share;  ///< of the scale, from 0
        std::string text;
    };

    /// `scale` is that of the text.
    Legends(ImDrawList& list, const ScreenRect& view, double scale);

    /// A scale of colours. What is beyond its end has the colour of the end.
    void addColors(const std::string& title, Color (*ramp)(double), std::span<const Tick> ticks);

    void addLength(const LengthKey& key);

  private:
    /// The upper left corner of the content of the next one, which is so high.
    ImVec2 place(const std::string& title, float height);

    ImDrawList& list_;
    float scale_, right_, bottom_;  // points
};

}  // namespace quadrille::app
