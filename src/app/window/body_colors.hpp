#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <quadrille/quadrille.hpp>

#include "app/window_options.hpp"

namespace quadrille::app {

/// Makes sure that there is something to see: if no body has a RectangleRenderer, as in a snapshot
/// of a headless run, all get one.
void ensureRenderers(World& world);

/// The colours of the bodies in the order in which they are drawn: static ones, then moving ones.
class BodyColors {
  public:
    /// Reads the colours of the RectangleRenderers; bodies without one get alpha 0 for good.
    void readEntities(const World& world);

    /// Colours by what `colorBy` says.
    std::span<const Color> update(const Simulation& simulation, ColorBy colorBy);

  private:
    std::vector<Color> entities_, colors_;
};

}  // namespace quadrille::app
