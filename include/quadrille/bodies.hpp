#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <quadrille/detail/anchor.hpp>
#include <quadrille/detail/column.hpp>

namespace quadrille {

/// Exact motion, kept by the law `continuous`.
template <class Real>
struct Anchors {
    bool enabled = false;
    bool incomplete = false;  ///< some rows may have no anchor
    std::vector<Anchor<Real>> rows;
    /// Bit 0 along x, bit 1 along y: whether the body rests on something and does not fall.
    Column<std::uint8_t> rests;

    void append() {
        if (!enabled) return;
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        rows.push_back({0, 0, 0, 0, unknown, unknown});
        rests.push_back(0);
        incomplete = true;
    }

    /// Takes the anchor of a body that was edited.
    void forget(std::size_t row) {
        if (!enabled) return;
        rows[row].timeX = rows[row].timeY = std::numeric_limits<double>::quiet_NaN();
        rests.set(row, 0);
        incomplete = true;
    }

    void move(std::size_t from, std::size_t to) {
        if (!enabled) return;
        rows[to] = rows[from];
        rests.move(from, to);
    }

    void shrink(std::size_t size) {
        if (!enabled) return;
        rows.resize(size);
        rests.shrink(size);
    }

    std::size_t bytes() const { return rows.capacity() * sizeof(Anchor<Real>) + rests.bytes(); }
};

/// The moving bodies in order of creation, one row each. Positions are centres in px, velocities in
/// px/s; sizes and masses that all bodies share are stored once.
template <class Real>
struct MovingBodies {
    std::vector<Real> x, y, vx, vy;
    Column<Real> halfWidth, halfHeight, mass;
    std::vector<std::uint32_t> entity;  ///< index of the entity
    Anchors<Real> anchors;

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
        Anchors<Real>* anchors = nullptr;
        std::size_t size() const { return x.size(); }
    } moving;
    struct Static {
        std::span<const Real> x, y, halfWidth, halfHeight;
        std::span<const std::uint32_t> entity;
        std::size_t size() const { return x.size(); }
    } fixed;
    /// Changes whenever rows were added, removed or edited from outside the simulation. Resolvers
    /// on a device keep copies by it, so who writes through this view must call
    /// World::bodiesEdited(); World::set, add and remove do it themselves.
    std::uint64_t revision = 0;

    std::size_t size() const { return moving.size() + fixed.size(); }
};

}  // namespace quadrille
