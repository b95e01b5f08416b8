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
/// bodies first, so that they lie below, then moving ones in order of creation. Where all that
/// moves is small on the screen, it is drawn as points.
///
/// Positions are streamed in every frame, relative to the camera's centre and as float: a scene far
/// from the origin is drawn as finely as any. Sizes are sent again only where the rows changed.
/// From 6 pixels on boxes are outlined, and marked where a moving one overlaps another.
class BoxLayer {
  public:
    BoxLayer();

    /// Streams the positions, and the sizes if `world` has changed its rows since the last call.
    void prepare(const World& world, const Viewport& viewport);

    /// Whether `prepare` found other rows than before, so that the colours are to be sent again.
    bool rowsChanged() const { return rowsChanged_; }

    /// One colour a body: the static ones, then the moving ones; alpha 0 hides a body.
    void setColors(std::span<const Color> colors);

    /// `opacity` below 1 lets more of what was drawn before shine through; outlines stay.
    void draw(const Viewport& viewport, double opacity) const;

  private:
    struct Program {
        GlProgram program;
        GLint scale, pixels, leastSide, first;

        explicit Program(const char* fragments);
        /// Of boxes that have at least so many pixels a side.
        void use(const Viewport& viewport, double least) const;
    };

    void drawBoxes(std::size_t count) const;
    void drawPoints(const Viewport& viewport, double opacity) const;
    void markOverlaps(const Viewport& viewport) const;

    Program boxes_;
    GLint opacity_, outline_;
    GlProgram points_;
    GLint pointScale_, pointPixels_, pointOpacity_;
    Program count_;
    GlProgram mark_;
    GlVertexArray array_, pointArray_;
    GlBuffer x_, y_, halfSize_, color_;
    bool hasPoints_ = false;  // large enough ones
    std::size_t bodies_ = 0, fixed_ = 0;
    double largestSide_ = 0;  // px, of what moves: the shorter side of the box with the longest
    double longestSide_ = 0;  // px, of what moves
    std::uint64_t revision_ = ~std::uint64_t(0);
    bool rowsChanged_ = false;
};

}  // namespace quadrille::app
