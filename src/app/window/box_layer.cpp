#include "app/window/box_layer.hpp"

#include <vector>

#include <quadrille/error.hpp>

namespace quadrille::app {

namespace {

// A pixel shows the part of it that the box covers, so boxes of a pixel or two move smoothly and
// keep their size. None is drawn smaller than a pixel. A box is one triangle around the quad that
// reaches half a pixel beyond it: small boxes cost the driver less than two triangles would.
constexpr const char* vertexSource = R"(
layout(location = 0) in float x;
layout(location = 1) in float y;
layout(location = 2) in vec2 halfSize;
layout(location = 3) in vec4 color;
uniform vec2 scale;    // clip units per px of the world
uniform float pixels;  // framebuffer pixels per px of the world
flat out vec2 halfPixels;
flat out vec4 boxColor;
out vec2 offset;  // from the centre, in pixels
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
    halfPixels = max(halfSize * pixels, vec2(0.5));
    offset = corner * (halfPixels + 0.5);
    boxColor = color;
    vec2 place = (vec2(x, y) + offset / pixels) * scale;
    gl_Position = color.a > 0.0 ? vec4(place, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
)";

constexpr const char* fragmentSource = R"(
flat in vec2 halfPixels;
flat in vec4 boxColor;
in vec2 offset;
uniform float opacity;
out vec4 pixel;
void main() {
    vec2 covered = min(offset + 0.5, halfPixels) - max(offset - 0.5, -halfPixels);
    covered = clamp(covered, 0.0, 1.0);
    pixel = vec4(boxColor.rgb, boxColor.a * opacity * covered.x * covered.y);
}
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

BoxLayer::BoxLayer()
    : program_(vertexSource, fragmentSource),
      scale_(program_.uniform("scale")),
      pixels_(program_.uniform("pixels")),
      opacity_(program_.uniform("opacity")) {
    glBindVertexArray(array_.id());
    glBindBuffer(GL_ARRAY_BUFFER, x_.id());
    instanceAttribute(0, 1, GL_FLOAT, false);
    glBindBuffer(GL_ARRAY_BUFFER, y_.id());
    instanceAttribute(1, 1, GL_FLOAT, false);
    glBindBuffer(GL_ARRAY_BUFFER, halfSize_.id());
    instanceAttribute(2, 2, GL_FLOAT, false);
    glBindBuffer(GL_ARRAY_BUFFER, color_.id());
    instanceAttribute(3, 4, GL_UNSIGNED_BYTE, true);
    glBindVertexArray(0);
}

void BoxLayer::prepare(const World& world, const Viewport& viewport) {
    const Vec2 origin = viewport.camera.center;
    world.visitBodies([&]<class Real>(const BodyView<Real>& bodies) {
        const auto& m = bodies.moving;
        const auto& f = bodies.fixed;
        count_ = bodies.size();
        stream<float>(x_, count_, [&](float* out) {
            out = relative<Real>(f.x, origin.x(), out);
            relative<Real>(m.x, origin.x(), out);
        });
        stream<float>(y_, count_, [&](float* out) {
            out = relative<Real>(f.y, origin.y(), out);
            relative<Real>(m.y, origin.y(), out);
        });
        rowsChanged_ = bodies.revision != revision_;
        if (!rowsChanged_) return;
        revision_ = bodies.revision;
        stream<float>(halfSize_, 2 * count_, [&](float* out) {
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
    const Vec2 scale = viewport.clipScale();
    program_.use();
    glUniform2f(scale_, float(scale.x()), float(scale.y()));
    glUniform1f(pixels_, float(viewport.pixelsPerUnit()));
    glUniform1f(opacity_, float(opacity));
    glBindVertexArray(array_.id());
    glDrawArraysInstanced(GL_TRIANGLES, 0, 3, static_cast<GLsizei>(count_));
    glBindVertexArray(0);
}

}  // namespace quadrille::app
