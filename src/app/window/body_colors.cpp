#include "app/window/body_colors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/window/colors.hpp"
#include "app/window/nice_numbers.hpp"

namespace quadrille::app {

namespace {

constexpr Color movingColor{0x4f, 0x9d, 0xdb}, staticColor{0x26, 0x30, 0x3b};

/// The end of the scale needs no more values than this to be found.
constexpr std::size_t mostSampled = 4096;

/// The share of the bodies whose value the scale shows.
double shareShown(ColorBy by) {
    switch (by) {
        case ColorBy::Energy:
            return 0.99;
        case ColorBy::SinceHit:
            return 0.95;
        default:
            return 1;
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

/// What is not finite has the colour of the top, and no part in finding it.
template <class Real, class ValueOf>
void BodyColors::colorByScale(const BodyView<Real>& bodies, Color (*ramp)(double),
                              ValueOf&& valueOf) {
    const std::size_t count = bodies.moving.size();
    values_.resize(count);
    for (std::size_t i = 0; i < count; ++i) values_[i] = static_cast<float>(valueOf(i));
    const double share = shareShown(scale_.by);
    const std::size_t stride = share < 1 ? count / mostSampled + 1 : 1;
    sample_.clear();
    for (std::size_t i = 0; i < count; i += stride) {
        if (std::isfinite(values_[i])) sample_.push_back(values_[i]);
    }
    if (share < 1) {
        scale_.top = niceCeiling(percentile(sample_, share));
    } else if (!sample_.empty()) {
        scale_.top = double(*std::max_element(sample_.begin(), sample_.end()));
    }
    if (!(scale_.top > 0) && scale_.by != ColorBy::SinceHit) return;
    // A table, since the ramp is dearer than the look-up.
    std::array<Color, 256> table;
    for (std::size_t k = 0; k < table.size(); ++k) table[k] = ramp(double(k) / 255);
    const float steps = scale_.top > 0 ? float(255 / scale_.top) : 0;
    for (std::size_t i = 0; i < count; ++i) {
        const bool beyond = double(values_[i]) > scale_.top;
        scale_.beyond |= beyond;
        Color& color = colors_[bodies.fixed.size() + i];
        const std::uint8_t alpha = color.a;
        color = beyond ? table.back() : table[static_cast<std::size_t>(values_[i] * steps)];
        color.a = alpha;
    }
}

std::span<const Color> BodyColors::update(const Simulation& simulation, ColorBy colorBy,
                                          const HitTimes& hits) {
    scale_ = {.by = colorBy};
    if (colorBy == ColorBy::Entity) return entities_;
    colors_ = entities_;
    const double now = simulation.time();
    simulation.world().visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        const auto squaredSpeed = [&](std::size_t i) {
            return double(m.vx[i] * m.vx[i] + m.vy[i] * m.vy[i]);
        };
        switch (colorBy) {
            case ColorBy::Speed:
                return colorByScale(bodies, speedColor,
                                    [&](std::size_t i) { return std::sqrt(squaredSpeed(i)); });
            case ColorBy::Energy:
                return colorByScale(bodies, energyColor, [&](std::size_t i) {
                    return double(m.mass[i]) * squaredSpeed(i) / 2;
                });
            case ColorBy::SinceHit:
                return colorByScale(bodies, sinceHitColor, [&](std::size_t i) {
                    // Of the past, what was hit later is not known to have been hit before.
                    const double since = now - hits.last(m.entity[i]);
                    return since >= 0 ? since : -HitTimes::never;
                });
            default:
                return colorByCell(simulation.cells(), bodies.fixed.size(), colors_);
        }
    });
    return colors_;
}

}  // namespace quadrille::app
