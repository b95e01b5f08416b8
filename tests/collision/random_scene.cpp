#include "random_scene.hpp"

#include <algorithm>
#include <cmath>

#include "support.hpp"

namespace quadrille {

namespace {

/// Draws positions and sizes for one scene.
class Placement {
  public:
    Placement(SceneKind kind, Random& random, const Vec2& world, int count)
        : kind_(kind), random_(random), world_(world), low_(-world / 2), count_(count) {
        for (Vec2& centre : centres_) centre = inside();
        point_ = inside();
        // Edges of quadtree cells of a world of 256 x 128, and of grid cells of 8, 13 and 26.
        constexpr std::array units = {8.0, 13.0, 26.0, 0.5};
        unit_ = units[static_cast<std::size_t>(random_.integer(0, 3))];
        common_ = size(0);
    }

    Vec2 position(int i) {
        switch (kind_) {
            case SceneKind::Clustered: {
                const Vec2 centre = centres_[static_cast<std::size_t>(i) % centres_.size()];
                const double spread = world_.minCoeff() / 20;
                return centre +
                       Vec2(random_.uniform(-spread, spread), random_.uniform(-spread, spread));
            }
            case SceneKind::CellBorders: {
                const auto columns = static_cast<std::int64_t>(world_.x() / unit_);
                const auto rows = static_cast<std::int64_t>(world_.y() / unit_);
                const std::int64_t crowd = std::min<std::int64_t>(12, columns);
                return low_ + unit_ * Vec2(double(random_.integer(-1, crowd)),
                                           double(random_.integer(-1, std::min(crowd, rows) + 1)));
            }
            case SceneKind::Outside:
                return outside();
            case SceneKind::OnePoint:
                return point_;
            default:
                return inside();
        }
    }

    /// `differ` is false where all boxes of the scene have one size.
    Vec2 size(int i, bool differ) { return differ ? size(i) : common_; }

  private:
    Vec2 size(int i) {
        switch (kind_) {
            case SceneKind::CellBorders:
                return unit_ * Vec2(double(random_.integer(1, 4)), double(random_.integer(1, 4)));
            case SceneKind::HugeAndTiny:
                if (i % std::max(2, count_ / 4) == 0) {
                    return {world_.x() * random_.uniform(0.3, 4),
                            world_.y() * random_.uniform(0.3, 4)};
                }
                return {std::pow(10, random_.uniform(-3, 1)), std::pow(10, random_.uniform(-3, 1))};
            default:
                return {random_.uniform(0.5, 16), random_.uniform(0.5, 16)};
        }
    }

    Vec2 inside() {
        return low_ + Vec2(random_.uniform(0, world_.x()), random_.uniform(0, world_.y()));
    }

    Vec2 outside() {
        switch (random_.integer(0, 3)) {
            case 0:
                return inside();
            case 1:
                return 3 * inside();
            case 2: {
                // Far out, and several at almost the same place there.
                const double far = random_.integer(0, 1) == 0 ? 1e5 : 1e9;
                return {random_.sign() * far + random_.uniform(-8, 8),
                        random_.sign() * far + random_.uniform(-8, 8)};
            }
            default: {
                const Vec2 p = inside();
                return random_.integer(0, 1) == 0 ? Vec2(random_.sign() * world_.x() / 2, p.y())
                                                  : Vec2(p.x(), random_.sign() * 1e9);
            }
        }
    }

    SceneKind kind_;
    Random& random_;
    Vec2 world_, low_;
    int count_;
    std::array<Vec2, 3> centres_;
    Vec2 point_;
    double unit_ = 8;
    Vec2 common_;
};

}  // namespace

std::string_view name(SceneKind kind) {
    switch (kind) {
        case SceneKind::Uniform:
            return "uniform";
        case SceneKind::Clustered:
            return "clustered";
        case SceneKind::CellBorders:
            return "cell borders";
        case SceneKind::HugeAndTiny:
            return "huge and tiny";
        case SceneKind::Outside:
            return "outside";
        case SceneKind::OnePoint:
            return "one point";
    }
    return "";
}

World randomScene(SceneKind kind, std::uint64_t seed, int most, double speed) {
    Random random(seed * 16 + static_cast<std::uint64_t>(kind));
    const std::array sizes = {Vec2(256, 128), Vec2(200, 120), Vec2(97.3, 611.7)};
    const Vec2 size = sizes[static_cast<std::size_t>(random.integer(0, 2))];
    World world({.size = size, .seed = seed});

    // A few scenes are nearly empty: such are special cases too.
    const int least = random.integer(0, 9) == 0 ? 0 : most / 4;
    const int count = static_cast<int>(random.integer(least, most));
    const bool differ = random.integer(0, 1) == 0;
    const bool withStatic = random.integer(0, 1) == 0;
    if (withStatic && random.integer(0, 3) == 0) world.addWalls({.thickness = 50});
    Placement placement(kind, random, size, count);
    for (int i = 0; i < count; ++i) {
        const Vec2 position = placement.position(i);
        const Vec2 extent = placement.size(i, differ);
        PhysicsBody body{.velocity = {random.uniform(-speed, speed), random.uniform(-speed, speed)},
                         .mass = differ ? random.uniform(0.1, 10) : 1};
        if (withStatic && random.integer(0, 4) == 0) body = fixed();
        makeBox(world, position, body, extent);
    }
    return world;
}

}  // namespace quadrille
