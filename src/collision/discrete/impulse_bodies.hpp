#pragma once

#include <quadrille/bodies.hpp>

#include "collision/resolver.hpp"
#include "collision/rules/impulse_contact.hpp"

/// The host's side of impulse_contact.hpp: from the engine's views and to its records.

namespace quadrille {

template <class Real>
SharedColumn<Real> makeSharedColumn(const ColumnView<Real>& column) {
    return {column.uniform() ? nullptr : column.values.data(), column.common};
}

template <class Real>
Bodies<Real> makeBodies(const BodyView<Real>& bodies) {
    const auto& m = bodies.moving;
    const auto& f = bodies.fixed;
    return {.moving = {.x = m.x.data(),
                       .y = m.y.data(),
                       .vx = m.vx.data(),
                       .vy = m.vy.data(),
                       .halfWidth = makeSharedColumn(m.halfWidth),
                       .halfHeight = makeSharedColumn(m.halfHeight),
                       .mass = makeSharedColumn(m.mass),
                       .entity = m.entity.data(),
                       .created = {},
                       .anchors = m.anchors != nullptr ? m.anchors->rows.data() : nullptr,
                       .rests = nullptr},
            .fixed = {.x = f.x.data(),
                      .y = f.y.data(),
                      .halfWidth = f.halfWidth.data(),
                      .halfHeight = f.halfHeight.data(),
                      .entity = f.entity.data(),
                      .created = {}}};
}

/// What observers are told about a contact; `stepStart` is in s since the start of the run.
template <class Real>
ContactRecord makeRecord(const PendingContact<Real>& c, double stepStart, bool collided) {
    constexpr std::uint32_t staticBit = PendingContact<Real>::staticBit;
    const auto b = static_cast<std::int64_t>(c.b & ~staticBit);
    return {.time = stepStart + static_cast<double>(c.sinceStart),
            .a = c.a,
            .b = (c.b & staticBit) != 0 ? -1 - b : b,
            .axes = c.axes,
            .senseX = c.senseX,
            .senseY = c.senseY,
            .collided = collided};
}

/// The same for a contact of the law `baseline`, which knows no times within a step; `b` is a row
/// of a moving body, or -1 - row of a static one.
template <class Real>
ContactRecord makeRecord(std::uint32_t a, std::int64_t b, const Penetration<Real>& p,
                         const StepParameters<Real>& step) {
    const auto sense = static_cast<std::int8_t>(p.sense);
    return {.time = step.start + static_cast<double>(step.dt),
            .a = a,
            .b = b,
            .axes = p.axis,
            .senseX = sense,
            .senseY = sense,
            .collided = true};
}

}  // namespace quadrille
