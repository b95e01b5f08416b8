#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <quadrille/column.hpp>

namespace quadrille {

/// How coordinates and velocities are stored and computed.
enum class Precision : std::uint8_t { Double, Float };

/// The moving bodies in order of creation, one row each. Positions are centres in px, velocities in
/// px/s; sizes and masses that all bodies share are stored once.
template <class Real>
struct MovingBodies {
    std::vector<Real> x, y, vx, vy;
    Column<Real> halfWidth, halfHeight, mass;
    std::vector<std::uint32_t> entity;  ///< index of the entity

    std::size_t size() const { return x.size(); }
};

/// The static bodies in order of creation.
template <class Real>
struct StaticBodies {
    std::vector<Real> x, y, halfWidth, halfHeight;
    std::vector<std::uint32_t> entity;

    std::size_t size() const { return x.size(); }
};

/// A handful of spans over all bodies; valid until a body is added or the world is flushed.
template <class Real>
struct BodyView {
    struct Moving {
        std::span<Real> x, y, vx, vy;
        ColumnView<Real> halfWidth, halfHeight, mass;
        std::span<const std::uint32_t> entity;
        std::size_t size() const { return x.size(); }
    } moving;
    struct Static {
        std::span<const Real> x, y, halfWidth, halfHeight;
        std::span<const std::uint32_t> entity;
        std::size_t size() const { return x.size(); }
    } fixed;
    /// Changes whenever rows were added, removed or edited from outside the simulation.
    std::uint64_t revision = 0;

    std::size_t size() const { return moving.size() + fixed.size(); }
};

}  // namespace quadrille
