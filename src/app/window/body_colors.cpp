#include "app/window/body_colors.hpp"

#include <algorithm>
#include <cmath>

#include "app/window/colors.hpp"

namespace quadrille::app {

namespace {

constexpr Color movingColor{0x4f, 0x9d, 0xdb}, staticColor{0x26, 0x30, 0x3b};

template <class Real>
void colorBySpeed(const BodyView<Real>& bodies, std::span<Color> colors) {
    const auto& m = bodies.moving;
    double most = 0;
    for (std::size_t i = 0; i < m.size(); ++i) {
        most = std::max(most, double(m.vx[i] * m.vx[i] + m.vy[i] * m.vy[i]));
    }
    if (!(most > 0)) return;
    // A table, since the ramp is dearer than the look-up.
    std::array<Color, 256> ramp;
    for (std::size_t k = 0; k < ramp.size(); ++k) ramp[k] = speedColor(double(k) / 255);
    const double scale = 255 / std::sqrt(most);
    for (std::size_t i = 0; i < m.size(); ++i) {
        const double speed = std::sqrt(double(m.vx[i] * m.vx[i] + m.vy[i] * m.vy[i]));
        Color& color = colors[bodies.fixed.size() + i];
        const std::uint8_t alpha = color.a;
        color = ramp[std::min<std::size_t>(static_cast<std::size_t>(speed * scale), 255)];
        color.a = alpha;
    }
}

void colorByCell(const Cells& cells, std::size_t fixed, std::span<Color> colors) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const Color color = cellColor(cells.coordinates[c]);
        for (const BodyRef body : cells[c]) {
            if (body.isStatic()) continue;  // walls stand in many cells and keep their colour
            Color& out = colors[fixed + body.row()];
            out = {color.r, color.g, color.b, out.a};
        }
    }
}

}  // namespace

void ensureRenderers(World& world) {
    world.visitBodies([&](const auto& bodies) {
        const auto any = [&](std::span<const std::uint32_t> rows) {
            return std::any_of(rows.begin(), rows.end(), [&](std::uint32_t index) {
                return world.has<RectangleRenderer>(world.entityAt(index));
            });
        };
        if (any(bodies.moving.entity) || any(bodies.fixed.entity)) return;
        for (const std::uint32_t index : bodies.fixed.entity) {
            world.add(world.entityAt(index), RectangleRenderer{staticColor});
        }
        for (const std::uint32_t index : bodies.moving.entity) {
            world.add(world.entityAt(index), RectangleRenderer{movingColor});
        }
    });
}

void BodyColors::readEntities(const World& world) {
    entities_.clear();
    world.visitBodies([&](const auto& bodies) {
        entities_.reserve(bodies.size());
        for (const auto& rows : {bodies.fixed.entity, bodies.moving.entity}) {
            for (const std::uint32_t index : rows) {
                const Entity entity = world.entityAt(index);
                entities_.push_back(world.has<RectangleRenderer>(entity)
                                        ? world.get<RectangleRenderer>(entity).color
                                        : Color{0, 0, 0, 0});
            }
        }
    });
}

std::span<const Color> BodyColors::update(const Simulation& simulation, ColorBy colorBy) {
    if (colorBy == ColorBy::Entity) return entities_;
    colors_ = entities_;
    simulation.world().visitBodies([&](const auto& bodies) {
        if (colorBy == ColorBy::Speed) {
            colorBySpeed(bodies, colors_);
        } else {
            colorByCell(simulation.cells(), bodies.fixed.size(), colors_);
        }
    });
    return colors_;
}

}  // namespace quadrille::app
