#pragma once

#include <cstdint>
#include <vector>

#include <quadrille/body_ref.hpp>

#include "collision/rules/event_order.hpp"
#include "collision/rules/paths.hpp"

namespace quadrille {

/// What a box of a PlainWorld is.
struct PlainBox {
    double x = 0, y = 0, vx = 0, vy = 0;
    double width = 2, height = 2, mass = 1;
};

/// A few bodies in columns of their own, for tests of the rules. The row of a body is the number of
/// its creation unless `created` says otherwise.
template <class Real, class Path>
class PlainWorld {
  public:
    using Motion = ExactMotion<Real, Path>;

    explicit PlainWorld(double gravityY = 0, double restitution = 1)
        : gravityY_(gravityY), restitution_(restitution) {}

    /// Returns the row.
    std::uint32_t add(const PlainBox& box) {
        const auto r = [](double value) { return static_cast<Real>(value); };
        const auto row = static_cast<std::uint32_t>(anchors.size());
        x.push_back(r(box.x));
        y.push_back(r(box.y));
        vx.push_back(r(box.vx));
        vy.push_back(r(box.vy));
        halfWidth.push_back(r(box.width / 2));
        halfHeight.push_back(r(box.height / 2));
        mass.push_back(r(box.mass));
        anchors.push_back({r(box.x), r(box.y), r(box.vx), r(box.vy), 0, 0});
        rests.push_back(0);
        entity.push_back(row);
        return row;
    }
    BodyRef addStatic(const PlainBox& box) {
        fixedX.push_back(static_cast<Real>(box.x));
        fixedY.push_back(static_cast<Real>(box.y));
        fixedHalfWidth.push_back(static_cast<Real>(box.width / 2));
        fixedHalfHeight.push_back(static_cast<Real>(box.height / 2));
        fixedEntity.push_back(1000 + static_cast<std::uint32_t>(fixedX.size()));
        return BodyRef::fixed(static_cast<std::uint32_t>(fixedX.size() - 1));
    }

    /// Valid until a body is added.
    Motion motion() {
        return {.bodies = {.moving = {.x = x.data(),
                                      .y = y.data(),
                                      .vx = vx.data(),
                                      .vy = vy.data(),
                                      .halfWidth = {halfWidth.data(), 0},
                                      .halfHeight = {halfHeight.data(), 0},
                                      .mass = {mass.data(), 0},
                                      .entity = entity.data(),
                                      .created = {created.empty() ? nullptr : created.data()},
                                      .anchors = anchors.data(),
                                      .rests = Path::falls ? rests.data() : nullptr},
                           .fixed = {.x = fixedX.data(),
                                     .y = fixedY.data(),
                                     .halfWidth = fixedHalfWidth.data(),
                                     .halfHeight = fixedHalfHeight.data(),
                                     .entity = fixedEntity.data(),
                                     .created = {}}},
                .gravityX = 0,
                .gravityY = gravityY_,
                .restitution = restitution_};
    }

    std::vector<Real> x, y, vx, vy, halfWidth, halfHeight, mass;
    std::vector<Anchor<Real>> anchors;
    std::vector<std::uint8_t> rests;
    std::vector<std::uint32_t> entity, created;
    std::vector<Real> fixedX, fixedY, fixedHalfWidth, fixedHalfHeight;
    std::vector<std::uint32_t> fixedEntity;

  private:
    double gravityY_, restitution_;
};

}  // namespace quadrille
