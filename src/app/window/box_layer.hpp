#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <quadrille/components.hpp>
#include <quadrille/world.hpp>

#include "app/window/gl_objects.hpp"
#include "app/window/viewport.hpp"

namespace quadrille::app {

/// Draws the boxes of all bodies that have a RectangleRenderer, in one instanced draw call: static
/// bodies first, so that they lie below, then moving ones in order of creation.
///
/// Positions are streamed in every frame, relative to the camera's centre and as float: a scene far
/// from the origin is drawn as finely as any. Sizes are sent again only where the rows changed.
class BoxLayer {
  public:
    BoxLayer();

    /// Streams the positions, and the sizes if `world` has changed its rows since the last call.
    void prepare(const World& world, const Viewport& viewport);

    /// Whether `prepare` found other rows than before, so that the colours are to be sent again.
    bool rowsChanged() const { return rowsChanged_; }

    /// One colour a body: the static ones, then the moving ones; alpha 0 hides a body.
    void setColors(std::span<const Color> colors);

    /// `opacity` below 1 lets what was drawn before shine through.
    void draw(const Viewport& viewport, double opacity) const;

  private:
    GlProgram program_;
    GLint scale_, pixels_, opacity_;
    GlVertexArray array_;
    GlBuffer x_, y_, halfSize_, color_;
    std::size_t count_ = 0;
    std::uint64_t revision_ = ~std::uint64_t(0);
    bool rowsChanged_ = false;
};

}  // namespace quadrille::app
