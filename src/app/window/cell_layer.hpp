#pragma once

#include <cstddef>

#include <quadrille/cells.hpp>

#include "app/window/gl_objects.hpp"
#include "app/window/viewport.hpp"
#include "app/window_options.hpp"

namespace quadrille::app {

/// Draws the cells of the partitioner: their borders, and how many bodies each of them holds.
class CellLayer {
  public:
    CellLayer();

    /// Sends the cells; to be called when they were made anew.
    void prepare(const Cells& cells);

    void draw(const Viewport& viewport, const Overlays& overlays) const;

  private:
    struct Program {
        GlProgram program;
        GLint offset, scale, pixels;

        explicit Program(const char* vertexSource);
        void use(const Viewport& viewport, const Vec2& origin) const;
    };

    Program fill_, lines_;
    GLint thickness_;
    GlVertexArray array_;
    GlBuffer instances_;
    std::size_t cells_ = 0, lineInstances_ = 0;
    Vec2 origin_{0, 0};  // what the positions in the buffer are relative to
};

}  // namespace quadrille::app
