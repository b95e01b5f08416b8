#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <quadrille/column.hpp>

namespace quadrille {

/// How coordinates and velocities are stored and computed.
enum class Precision : std::uint8_t { Double, Float };

/// Exact motion, kept by the law `continuous`: where and when each body's straight path began. Rows
/// without an anchor (new, or edited from outside) have NaN as their time.
template <class Real>
struct Anchors {
    bool enabled = false;
    std::size_t missing = 0;      ///< rows that may have no anchor
    std::vector<Real> x, y;       ///< px
    Column<double> timeX, timeY;  ///< s

    /// Anchors all bodies where they are.
    void start(std::span<const Real> px, std::span<const Real> py, double now) {
        *this = {};
        enabled = true;
        x.assign(px.begin(), px.end());
        y.assign(py.begin(), py.end());
        for (std::size_t i = 0; i < x.size(); ++i) {
            timeX.push_back(now);
            timeY.push_back(now);
        }
    }

    /// Anchors one body.
    void put(std::size_t row, Real px, Real py, double now) {
        x[row] = px;
        y[row] = py;
        timeX.set(row, now);
        timeY.set(row, now);
    }

    void append() {
        if (!enabled) return;
        x.push_back(0);
        y.push_back(0);
        timeX.push_back(std::numeric_limits<double>::quiet_NaN());
        timeY.push_back(std::numeric_limits<double>::quiet_NaN());
        ++missing;
    }

    /// Takes the anchor of a body that was edited.
    void forget(std::size_t row) {
        if (!enabled) return;
        timeX.set(row, std::numeric_limits<double>::quiet_NaN());
        timeY.set(row, std::numeric_limits<double>::quiet_NaN());
        ++missing;
    }

    void move(std::size_t from, std::size_t to) {
        if (!enabled) return;
        for (auto* column : {&x, &y}) (*column)[to] = (*column)[from];
        for (auto* column : {&timeX, &timeY}) column->move(from, to);
    }

    void shrink(std::size_t size) {
        if (!enabled) return;
        for (auto* column : {&x, &y}) column->resize(size);
        for (auto* column : {&timeX, &timeY}) column->shrink(size);
    }

    std::size_t bytes() const {
        return (x.capacity() + y.capacity()) * sizeof(Real) + timeX.bytes() + timeY.bytes();
    }
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
