#include "app/window/box_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <quadrille/error.hpp>

namespace quadrille::app {

namespace {

/// Boxes have an outline from so many pixels a side.
constexpr double leastOutlined = 6;
/// Up to so many pixels, which is before any part of an outline shows, boxes are drawn as points.
constexpr double mostPoint = 4;

// A pixel shows the part of it that the box covers, so boxes of a pixel or two move smoothly and
// keep their size; a smaller one is spread over a pixel, as much fainter, but never beyond sight.
// A box is one triangle around the quad that reaches half a pixel beyond it: small boxes cost the
// driver less than two triangles would.
constexpr const char* vertexSource = R"(
layout(location = 0) in float x;
layout(location = 1) in float y;
layout(location = 2) in vec2 halfSize;
layout(location = 3) in vec4 color;
uniform vec2 scale;    // clip units per px of the world
uniform float pixels;  // framebuffer pixels per px of the world
uniform float leastSide;  // pixels; smaller boxes are left out
uniform int first;        // instances before it are left out
flat out vec2 halfPixels;
flat out vec4 boxColor;
out vec2 offset;  // from the centre, in pixels
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
    vec2 size = 2.0 * halfSize * pixels;
    vec2 share = min(size, vec2(1.0));
    halfPixels = max(size, vec2(1.0)) / 2.0;
    offset = corner * (halfPixels + 0.5);
    boxColor = vec4(color.rgb, color.a * max(share.x * share.y, 0.2));
    vec2 place = (vec2(x, y) + offset / pixels) * scale;
    bool shown = color.a > 0.0 && min(size.x, size.y) >= leastSide && gl_InstanceID >= first;
    gl_Position = shown ? vec4(place, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
)";

// From 6 pixels on a box has an outline, and what lies below shines through the rest of it.
constexpr const char* fragmentSource = R"(
flat in vec2 halfPixels;
flat in vec4 boxColor;
in vec2 offset;
uniform float opacity;
uniform float outline;  // pixels
out vec4 pixel;
void main() {
    vec2 covered = min(offset + 0.5, halfPixels) - max(offset - 0.5, -halfPixels);
    covered = clamp(covered, 0.0, 1.0);
    vec2 depth = halfPixels - abs(offset);  // below the sides
    float inside = clamp(min(depth.x, depth.y) - outline + 0.5, 0.0, 1.0);
    float outlined = clamp(2.0 * min(halfPixels.x, halfPixels.y) - 5.0, 0.0, 1.0);
    float shown = mix(mix(opacity, 1.0, outlined), 0.45 * opacity, inside * outlined);
    pixel = vec4(boxColor.rgb, boxColor.a * shown * covered.x * covered.y);
}
)";

// The same for a box that is smaller than its outline would be, as a point, which costs a driver
// less than a triangle.
constexpr const char* pointVertices = R"(
layout(location = 0) in float x;
layout(location = 1) in float y;
layout(location = 2) in vec2 halfSize;
layout(location = 3) in vec4 color;
uniform vec2 scale;
uniform float pixels;
flat out vec2 halfPixels;
flat out vec4 boxColor;
flat out float reach;  // of the point, pixels
void main() {
    vec2 size = 2.0 * halfSize * pixels;
    vec2 share = min(size, vec2(1.0));
    halfPixels = max(size, vec2(1.0)) / 2.0;
    reach = max(halfPixels.x, halfPixels.y) + 0.5;
    boxColor = vec4(color.rgb, color.a * max(share.x * share.y, 0.2));
    gl_PointSize = 2.0 * reach;
    gl_Position = color.a > 0.0 ? vec4(vec2(x, y) * scale, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
)";
constexpr const char* pointSource = R"(
flat in vec2 halfPixels;
flat in vec4 boxColor;
flat in float reach;
uniform float opacity;
out vec4 pixel;
void main() {
    vec2 offset = (2.0 * gl_PointCoord - 1.0) * reach;
    vec2 covered = min(offset + 0.5, halfPixels) - max(offset - 0.5, -halfPixels);
    covered = clamp(covered, 0.0, 1.0);
    pixel = vec4(boxColor.rgb, boxColor.a * opacity * covered.x * covered.y);
}
)";

// A pixel belongs to a box that holds its centre, by more than what is lost to rounding.
constexpr const char* countSource = R"(
flat in vec2 halfPixels;
in vec2 offset;
out vec4 pixel;
void main() {
    vec2 depth = halfPixels - abs(offset);
    if (min(depth.x, depth.y) < 0.03) discard;
    pixel = vec4(0.0);
}
)";

constexpr const char* markVertices = R"(
void main() {
    gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);
}
)";
constexpr const char* markSource = R"(
out vec4 pixel;
void main() { pixel = vec4(1.0, 0.16, 0.22, 0.75); }
)";

/// Replaces the content of a buffer by `count` values that `fill` writes to their place.
template <class T, class Fill>
void stream(const GlBuffer& buffer, std::size_t count, Fill&& fill) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    const auto bytes = static_cast<GLsizeiptr>(count * sizeof(T));
    // New storage each time, so that nobody waits for the frame that still reads the old one.
    glBufferData(GL_ARRAY_BUFFER, bytes, nullptr, GL_STREAM_DRAW);
    if (count == 0) return;
    void* const place = glMapBufferRange(GL_ARRAY_BUFFER, 0, bytes,
                                         GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (place == nullptr) throw Error("OpenGL has no memory for the boxes");
    fill(static_cast<T*>(place));
    glUnmapBuffer(GL_ARRAY_BUFFER);
}

template <class Real>
float* relative(std::span<const Real> values, double origin, float* out) {
    const std::size_t count = values.size();
    for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<float>(values[i] - origin);
    return out + count;
}

}  // namespace

BoxLayer::Program::Program(const char* fragments)
    : program(vertexSource, fragments),
      scale(program.uniform("scale")),
      pixels(program.uniform("pixels")),
      leastSide(program.uniform("leastSide")),
      first(program.uniform("first")) {}

void BoxLayer::Program::use(const Viewport& viewport, double least) const {
    const Vec2 clipScale = viewport.clipScale();
    program.use();
    glUniform2f(scale, float(clipScale.x()), float(clipScale.y()));
    glUniform1f(pixels, float(viewport.pixelsPerUnit()));
    glUniform1f(leastSide, float(least));
    glUniform1i(first, 0);
}

BoxLayer::BoxLayer()
    : boxes_(fragmentSource),
      opacity_(boxes_.program.uniform("opacity")),
      outline_(boxes_.program.uniform("outline")),
      points_(pointVertices, pointSource),
      pointScale_(points_.uniform("scale")),
      pointPixels_(points_.uniform("pixels")),
      pointOpacity_(points_.uniform("opacity")),
      count_(countSource),
      mark_(markVertices, markSource) {
    std::array<GLfloat, 2> sizes{};
    glGetFloatv(GL_POINT_SIZE_RANGE, sizes.data());
    hasPoints_ = sizes[1] >= mostPoint + 1;  // half a pixel around the box
    for (const bool instanced : {true, false}) {
        glBindVertexArray(instanced ? array_.id() : pointArray_.id());
        glBindBuffer(GL_ARRAY_BUFFER, x_.id());
        instanceAttribute(0, 1, GL_FLOAT, false);
        glBindBuffer(GL_ARRAY_BUFFER, y_.id());
        instanceAttribute(1, 1, GL_FLOAT, false);
        glBindBuffer(GL_ARRAY_BUFFER, halfSize_.id());
        instanceAttribute(2, 2, GL_FLOAT, false);
        glBindBuffer(GL_ARRAY_BUFFER, color_.id());
        instanceAttribute(3, 4, GL_UNSIGNED_BYTE, true);
        for (GLuint i = 0; i < 4 && !instanced; ++i) glVertexAttribDivisor(i, 0);
    }
    glBindVertexArray(0);
}

void BoxLayer::prepare(const World& world, const Viewport& viewport) {
    const Vec2 origin = viewport.camera.center;
    world.visitBodies([&]<class Real>(const BodyView<Real>& bodies) {
        const auto& m = bodies.moving;
        const auto& f = bodies.fixed;
        bodies_ = bodies.size();
        fixed_ = f.size();
        stream<float>(x_, bodies_, [&](float* out) {
            out = relative<Real>(f.x, origin.x(), out);
            relative<Real>(m.x, origin.x(), out);
        });
        stream<float>(y_, bodies_, [&](float* out) {
            out = relative<Real>(f.y, origin.y(), out);
            relative<Real>(m.y, origin.y(), out);
        });
        rowsChanged_ = bodies.revision != revision_;
        if (!rowsChanged_) return;
        revision_ = bodies.revision;
        largestSide_ = longestSide_ = 0;
        for (std::size_t i = 0; i < m.size(); ++i) {
            const double half = double(std::min(m.halfWidth[i], m.halfHeight[i]));
            largestSide_ = std::max(largestSide_, 2 * half);
            const double longer = double(std::max(m.halfWidth[i], m.halfHeight[i]));
            longestSide_ = std::max(longestSide_, 2 * longer);
        }
        stream<float>(halfSize_, 2 * bodies_, [&](float* out) {
            for (std::size_t i = 0; i < f.size(); ++i) {
                *out++ = static_cast<float>(f.halfWidth[i]);
                *out++ = static_cast<float>(f.halfHeight[i]);
            }
            for (std::size_t i = 0; i < m.size(); ++i) {
                *out++ = static_cast<float>(m.halfWidth[i]);
                *out++ = static_cast<float>(m.halfHeight[i]);
            }
        });
    });
}

void BoxLayer::setColors(std::span<const Color> colors) {
    glBindBuffer(GL_ARRAY_BUFFER, color_.id());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(colors.size_bytes()), colors.data(),
                 GL_STREAM_DRAW);
}

void BoxLayer::draw(const Viewport& viewport, double opacity) const {
    boxes_.use(viewport, 0);
    glUniform1f(opacity_, float(opacity));
    glUniform1f(outline_, float(std::max(1.0, std::round(viewport.pixelRatio))));
    glBindVertexArray(array_.id());
    const bool small = hasPoints_ && longestSide_ * viewport.pixelsPerUnit() <= mostPoint;
    drawBoxes(small ? fixed_ : bodies_);
    if (small) drawPoints(viewport, opacity);
    if (largestSide_ * viewport.pixelsPerUnit() >= leastOutlined) markOverlaps(viewport);
    glBindVertexArray(0);
}

/// The moving boxes.
void BoxLayer::drawPoints(const Viewport& viewport, double opacity) const {
    const Vec2 clipScale = viewport.clipScale();
    points_.use();
    glUniform2f(pointScale_, float(clipScale.x()), float(clipScale.y()));
    glUniform1f(pointPixels_, float(viewport.pixelsPerUnit()));
    glUniform1f(pointOpacity_, float(opacity));
    glEnable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(pointArray_.id());
    glDrawArrays(GL_POINTS, static_cast<GLint>(fixed_), static_cast<GLsizei>(bodies_ - fixed_));
}

void BoxLayer::drawBoxes(std::size_t count) const {
    glDrawArraysInstanced(GL_TRIANGLES, 0, 3, static_cast<GLsizei>(count));
}

/// Counts the moving boxes over each pixel in the stencil buffer, whose highest bit says that a
/// static one is there: these may overlap each other.
void BoxLayer::markOverlaps(const Viewport& viewport) const {
    constexpr GLuint wall = 0x80, movers = 0x7f;
    glEnable(GL_STENCIL_TEST);
    glStencilMask(wall | movers);
    glClear(GL_STENCIL_BUFFER_BIT);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    count_.use(viewport, leastOutlined);
    glStencilFunc(GL_ALWAYS, wall, wall);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glStencilMask(wall);
    drawBoxes(fixed_);
    // What is beyond one or two makes no difference, and must not reach the highest bit.
    glUniform1i(count_.first, static_cast<GLint>(fixed_));
    glStencilFunc(GL_GREATER, movers, movers);
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    glStencilMask(movers);
    drawBoxes(bodies_);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    mark_.use();
    glStencilMask(wall | movers);
    glStencilOp(GL_KEEP, GL_KEEP, GL_ZERO);  // none is marked twice
    glStencilFunc(GL_LEQUAL, 2, movers);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glStencilFunc(GL_LEQUAL, wall | 1, wall | movers);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_STENCIL_TEST);
}

}  // namespace quadrille::app
