#pragma once

#include <vector>

#include "app/window/box_layer.hpp"
#include "app/window/cell_layer.hpp"
#include "app/window/workbench.hpp"

namespace quadrille::app {

/// Draws the run beside the one that the window shows, and gives the bodies of both their colours:
/// those whose velocities differ are red.
class ComparisonLayer {
  public:
    /// Streams what the second run has, and colours the boxes of the first, `boxes`, too.
    void prepare(const Workbench& bench, const Viewport& second, BoxLayer& boxes);

    void draw(const Viewport& second, const Overlays& overlays, double opacity) const;

  private:
    void colour(const World& world, std::span<const std::uint8_t> wrong, BoxLayer& boxes);

    BoxLayer boxes_;
    CellLayer cells_;
    std::vector<Color> colors_;
};

}  // namespace quadrille::app
