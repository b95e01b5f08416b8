#pragma once

#include <cstdint>
#include <span>

#include <quadrille/bodies.hpp>

#include "collision/rules/bodies.hpp"

namespace quadrille {

/// The columns of state that a law may ask for beside position and velocity.
struct KeptColumns {
    bool anchors = false;
    bool rests = false;
};

/// What was edited since a law advanced the bodies last.
enum class Edits : std::uint8_t {
    None,
    Everything,  ///< rows, sizes, masses, static bodies or the physics, or all that is below
    Values,      ///< positions and velocities of moving bodies, and nothing else
};

/// The bodies as a law advances them: positions, velocities and the columns that it asked for can
/// be written, and nobody counts that as an edit.
template <class Real>
struct LawBodies : MutableBodyView<Real> {
    std::span<Anchor<Real>> anchors;  ///< one a moving row, or empty
    std::span<std::uint8_t> rests;    ///< the same
    Edits edits = Edits::None;
    /// Positions and velocities are those of the start of the step; else, of an earlier time, and
    /// the anchors say what they are.
    bool placed = true;

    /// The same over plain pointers, for the rules.
    Bodies<Real> plain() const {
        const auto shared = [](const ColumnView<Real>& column) {
            return SharedColumn<Real>{column.uniform() ? nullptr : column.values.data(),
                                      column.common};
        };
        const auto numbers = [](const CreationOrder& order) {
            return CreationNumbers{order.isRowOrder() ? nullptr : order.numbers.data()};
        };
        const auto& m = this->moving;
        const auto& f = this->fixed;
        return {.moving = {.x = m.x.data(),
                           .y = m.y.data(),
                           .vx = m.vx.data(),
                           .vy = m.vy.data(),
                           .halfWidth = shared(m.halfWidth),
                           .halfHeight = shared(m.halfHeight),
                           .mass = shared(m.mass),
                           .entity = m.entity.data(),
                           .created = numbers(m.created),
                           .anchors = anchors.empty() ? nullptr : anchors.data(),
                           .rests = rests.empty() ? nullptr : rests.data()},
                .fixed = {.x = f.x.data(),
                          .y = f.y.data(),
                          .halfWidth = f.halfWidth.data(),
                          .halfHeight = f.halfHeight.data(),
                          .entity = f.entity.data(),
                          .created = numbers(f.created)}};
    }
};

}  // namespace quadrille
