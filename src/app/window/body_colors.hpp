#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <quadrille/quadrille.hpp>

#include "app/window/hit_times.hpp"
#include "app/window_options.hpp"

namespace quadrille::app {

/// Makes sure that there is something to see: if no body has a RectangleRenderer, as in a snapshot
/// of a headless run, all get one.
void ensureRenderers(World& world);

/// What the colours of bodies stand for: 0 is one end of the scale, `top` the other.
struct ColorScale {
    ColorBy by = ColorBy::Entity;
    double top = 0;       ///< 0: there is nothing to tell apart
    bool beyond = false;  ///< some are beyond the top, and have its colour
};

/// The colours of the bodies in the order in which they are drawn: static ones, then moving ones.
class BodyColors {
  public:
    /// Reads the colours of the RectangleRenderers; bodies without one get alpha 0 for good.
    void readEntities(const World& world);

    /// Colours by what `colorBy` says. The scale ends at the fastest body of now; at an energy, or
    /// a time since the last hit, that few are beyond.
    std::span<const Color> update(const Simulation& simulation, ColorBy colorBy,
                                  const HitTimes& hits);

    /// Of the last update.
    const ColorScale& scale() const { return scale_; }

  private:
    template <class Real, class ValueOf>
    void colorByScale(const BodyView<Real>& bodies, Color (*ramp)(double), ValueOf&& valueOf);

    std::vector<Color> entities_, colors_;
    std::vector<float> values_, sample_;
    ColorScale scale_;
};

}  // namespace quadrille::app
