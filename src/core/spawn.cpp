#include "core/spawn.hpp"

#include <cmath>

namespace quadrille {

namespace {

/// Rows and columns of roughly square pitch that hold `count` places, centred in the region.
class Lattice {
  public:
    Lattice(const Vec2& low, const Vec2& high, std::uint64_t count) : low_(low) {
        const Vec2 extent = high - low;
        const double ideal = std::sqrt(double(count) * extent.x() / extent.y());
        const double most = double(count);
        columns_ = static_cast<std::uint64_t>(std::ceil(!(ideal >= 1)  ? 1
                                                        : ideal < most ? ideal
                                                                       : most));
        const std::uint64_t rows = (count + columns_ - 1) / columns_;
        pitch_ = Vec2(extent.x() / double(columns_), extent.y() / double(rows));
    }

    Vec2 place(std::uint64_t i) const {
        const double column = double(i % columns_);
        const double row = double(i / columns_);
        return low_ + Vec2((column + 0.5) * pitch_.x(), (row + 0.5) * pitch_.y());
    }

  private:
    Vec2 low_;
    Vec2 pitch_;
    std::uint64_t columns_;
};

/// Side of a square with density ~ 1 / side^2 in [low, high], by inversion: many small bodies and a
/// few large ones, each decade of sides with the same share of the area.
double sampleSide(Random& random, const Vec2& sides) {
    return sides.x() / (1 - random.uniform(0, 1) * (1 - sides.x() / sides.y()));
}

}  // namespace

Entity BodyMaker::make(const Transform& transform, const BoxCollider& collider,
                       const PhysicsBody& body, const Color& color) const {
    const Entity entity = world.create();
    world.add(entity, transform, collider, body);
    if (renderers) world.add(entity, RectangleRenderer{color});
    return entity;
}

void spawn(const SpawnGroup& group, const Vec2& room, const BodyMaker& maker) {
    if (group.count == 0) return;
    Random& random = maker.world.random();
    const auto [low, high] = group.region.value_or(std::pair<Vec2, Vec2>(-room / 2, room / 2));
    const Lattice lattice(low, high, group.count);
    const auto slowest = static_cast<std::int64_t>(group.speed.x());
    const auto fastest = static_cast<std::int64_t>(group.speed.y());
    const auto speed = [&] {
        const double sign = random.sign();
        return sign * static_cast<double>(random.integer(slowest, fastest));
    };
    for (std::uint64_t i = 0; i < group.count; ++i) {
        Vec2 position;
        if (group.pattern == SpawnGroup::Pattern::Lattice) {
            position = lattice.place(i);
            if (group.jitter > 0) {
                position.x() += random.uniform(-group.jitter, group.jitter);
                position.y() += random.uniform(-group.jitter, group.jitter);
            }
        } else {
            position.x() = random.uniform(low.x(), high.x());
            position.y() = random.uniform(low.y(), high.y());
        }
        Vec2 size = group.size;
        if (group.sides) {
            const double side = sampleSide(random, *group.sides);
            size = Vec2(side, side);
        }
        PhysicsBody body;
        body.velocity.x() = speed();
        body.velocity.y() = speed();
        body.mass = group.density ? *group.density * size.x() * size.y() : group.mass;
        maker.make(Transform{position}, BoxCollider{size}, body, group.color);
    }
}

}  // namespace quadrille
