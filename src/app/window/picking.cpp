#include "app/window/picking.hpp"

#include <algorithm>
#include <cmath>

namespace quadrille::app {

std::optional<Entity> bodyAt(const World& world, const Vec2& place, double tolerance) {
    double nearest = tolerance;
    std::optional<Entity> found;
    const auto consider = [&](const auto& rows) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const double dx = std::abs(double(rows.x[i]) - place.x()) - double(rows.halfWidth[i]);
            const double dy = std::abs(double(rows.y[i]) - place.y()) - double(rows.halfHeight[i]);
            const double distance = std::max({dx, dy, 0.0});
            if (distance > nearest) continue;
            const Entity entity = world.entityAt(rows.entity[i]);
            if (!world.has<RectangleRenderer>(entity)) continue;
            nearest = distance;
            found = entity;
        }
    };
    // In the order of drawing.
    world.visitBodies([&](const auto& bodies) {
        consider(bodies.fixed);
        consider(bodies.moving);
    });
    return found;
}

}  // namespace quadrille::app
