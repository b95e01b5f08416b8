#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <quadrille/detail/column.hpp>

namespace quadrille {

/// All bodies, to be read: a handful of spans, valid until a body is added or the world is flushed,
/// edited or stepped. Positions are centres in px, velocities in px/s; sizes and masses that all
/// bodies share are stored once. A row is a place in storage and says nothing about order:
/// `created` does.
template <class Real>
struct BodyView {
    struct Moving {
        std::span<const Real> x, y, vx, vy;
        ColumnView<Real> halfWidth, halfHeight, mass;
        std::span<const std::uint32_t> entity;  ///< index of the entity
        CreationOrder created;
        std::size_t size() const { return x.size(); }
    } moving;
    struct Static {
        std::span<const Real> x, y, halfWidth, halfHeight;
        std::span<const std::uint32_t> entity;
        CreationOrder created;
        std::size_t size() const { return x.size(); }
    } fixed;
    /// Changes whenever rows were added, removed or edited from outside the simulation.
    std::uint64_t revision = 0;
    /// Changes with the revision unless only positions and velocities of moving bodies were edited.
    std::uint64_t layout = 0;

    std::size_t size() const { return moving.size() + fixed.size(); }
};

/// The same with positions and velocities that can be written.
template <class Real>
struct MutableBodyView {
    struct Moving {
        std::span<Real> x, y, vx, vy;
        ColumnView<Real> halfWidth, halfHeight, mass;
        std::span<const std::uint32_t> entity;
        CreationOrder created;
        std::size_t size() const { return x.size(); }
    } moving;
    typename BodyView<Real>::Static fixed;
    std::uint64_t revision = 0;
    std::uint64_t layout = 0;

    std::size_t size() const { return moving.size() + fixed.size(); }

    BodyView<Real> read() const {
        const auto& m = moving;
        return {.moving = {.x = m.x,
                           .y = m.y,
                           .vx = m.vx,
                           .vy = m.vy,
                           .halfWidth = m.halfWidth,
                           .halfHeight = m.halfHeight,
                           .mass = m.mass,
                           .entity = m.entity,
                           .created = m.created},
                .fixed = fixed,
                .revision = revision,
                .layout = layout};
    }
};

}  // namespace quadrille
