#include "app/window/cell_layer.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "app/window/colors.hpp"

namespace quadrille::app {

namespace {

struct CellInstance {
    float x, y, width, height;
    Color color;
};

// Corners are rounded to whole pixels, so that neighbours share their border exactly.
#define QUADRILLE_CELL_TO_PIXELS                                            \
    "layout(location = 0) in vec4 cell;\n"                                  \
    "layout(location = 1) in vec4 color;\n"                                 \
    "uniform vec2 offset;  // from the camera to the origin of the cells\n" \
    "uniform float scale;  // pixels per px of the world\n"                 \
    "uniform vec2 pixels;  // size of the view\n"                           \
    "vec2 toPixels(vec2 place) {\n"                                         \
    "    return floor((place + offset) * scale + 0.5 * pixels + 0.5);\n"    \
    "}\n"

constexpr const char* fillVertices = QUADRILLE_CELL_TO_PIXELS R"(
flat out vec4 fill;
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    fill = color;
    vec2 place = toPixels(cell.xy + corner * cell.zw);
    gl_Position = vec4(place / pixels * 2.0 - 1.0, 0.0, 1.0);
}
)";

// Two thin quads, along the left and the lower side: the other two belong to the neighbours.
// The lines of cells that are only a few pixels wide fade, or they would hide everything.
constexpr const char* lineVertices = QUADRILLE_CELL_TO_PIXELS R"(
uniform float thickness;
flat out vec4 fill;
void main() {
    int side = gl_VertexID / 6;
    int k = gl_VertexID % 6;
    vec2 corner = k == 0 ? vec2(0, 0) : k == 1 || k == 3 ? vec2(1, 0)
                : k == 2 || k == 4 ? vec2(0, 1) : vec2(1, 1);
    vec2 low = toPixels(cell.xy);
    vec2 high = toPixels(cell.xy + cell.zw);
    vec2 size = side == 0 ? vec2(thickness, high.y - low.y) : vec2(high.x - low.x, thickness);
    float width = max(high.x - low.x, high.y - low.y) / thickness;
    fill = vec4(0.62, 0.70, 0.78, 0.40 * smoothstep(1.0, 8.0, width));
    gl_Position = vec4((low + corner * size) / pixels * 2.0 - 1.0, 0.0, 1.0);
}
)";

#undef QUADRILLE_CELL_TO_PIXELS

constexpr const char* fragmentSource = R"(
flat in vec4 fill;
out vec4 pixel;
void main() { pixel = fill; }
)";

}  // namespace

CellLayer::Program::Program(const char* vertexSource)
    : program(vertexSource, fragmentSource),
      offset(program.uniform("offset")),
      scale(program.uniform("scale")),
      pixels(program.uniform("pixels")) {}

void CellLayer::Program::use(const Viewport& viewport, const Vec2& origin) const {
    const Vec2 toOrigin = origin - viewport.camera.center;
    program.use();
    glUniform2f(offset, float(toOrigin.x()), float(toOrigin.y()));
    glUniform1f(scale, float(viewport.pixelsPerUnit()));
    glUniform2f(pixels, float(viewport.view.width * viewport.pixelRatio),
                float(viewport.view.height * viewport.pixelRatio));
}

CellLayer::CellLayer()
    : fill_(fillVertices), lines_(lineVertices), thickness_(lines_.program.uniform("thickness")) {
    glBindVertexArray(array_.id());
    glBindBuffer(GL_ARRAY_BUFFER, instances_.id());
    instanceAttribute(0, 4, GL_FLOAT, false, sizeof(CellInstance), 0);
    instanceAttribute(1, 4, GL_UNSIGNED_BYTE, true, sizeof(CellInstance),
                      offsetof(CellInstance, color));
    glBindVertexArray(0);
}

void CellLayer::prepare(const Cells& cells) {
    constexpr std::uint8_t heatAlpha = 200;
    const std::size_t most = loadOf(cells).maxBodies;
    std::vector<CellInstance> instances;
    instances.reserve(cells.size() + 2);
    origin_ = cells.origin;
    Vec2 high(0, 0);  // of all cells
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const Bounds bounds = cells.bounds(c);
        const Vec2 low = bounds.low - origin_;
        const Vec2 size = bounds.high - bounds.low;
        const std::size_t count = cells[c].size();
        Color color = heatColor(heatScale(count, most));
        color.a = count > 0 ? heatAlpha : 0;
        instances.push_back(
            {float(low.x()), float(low.y()), float(size.x()), float(size.y()), color});
        high = high.cwiseMax(low + size);
    }
    cells_ = instances.size();
    if (cells_ > 0) {
        // The right and the upper border, which are nobody's left or lower side.
        instances.push_back({float(high.x()), 0, 0, float(high.y()), {}});
        instances.push_back({0, float(high.y()), float(high.x()), 0, {}});
    }
    lineInstances_ = instances.size();
    glBindBuffer(GL_ARRAY_BUFFER, instances_.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances.size() * sizeof(CellInstance)),
                 instances.data(), GL_STREAM_DRAW);
}

void CellLayer::draw(const Viewport& viewport, const Overlays& overlays) const {
    glBindVertexArray(array_.id());
    if (overlays.heatMap) {
        fill_.use(viewport, origin_);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(cells_));
    }
    if (overlays.gridlines) {
        lines_.use(viewport, origin_);
        glUniform1f(thickness_, float(std::max(1.0, std::floor(viewport.pixelRatio))));
        glDrawArraysInstanced(GL_TRIANGLES, 0, 12, static_cast<GLsizei>(lineInstances_));
    }
    glBindVertexArray(0);
}

}  // namespace quadrille::app
