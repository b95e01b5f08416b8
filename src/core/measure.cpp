#include <algorithm>
#include <cmath>

#include <quadrille/creation_ranks.hpp>
#include <quadrille/measure.hpp>

#include "collision/broad/partitioner.hpp"
#include "collision/pairs/narrow_phase.hpp"

namespace quadrille {

double kineticEnergy(const World& world) { return totalEnergy(world, Vec2(0, 0)); }

double totalEnergy(const World& world, const Vec2& gravity) {
    return world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        const CreationRanks ranks(m.created, m.size());
        double sum = 0;
        for (std::size_t place = 0; place < m.size(); ++place) {
            const std::size_t i = ranks.rowAt(place);
            const Vec2 v(m.vx[i], m.vy[i]);
            double energy = v.squaredNorm() / 2;
            if (gravity != Vec2(0, 0)) energy -= gravity.dot(Vec2(m.x[i], m.y[i]));
            sum += static_cast<double>(m.mass[i]) * energy;
        }
        return sum;
    });
}

Vec2 momentum(const World& world) {
    return world.visitBodies([](const auto& bodies) {
        const auto& m = bodies.moving;
        const CreationRanks ranks(m.created, m.size());
        Vec2 sum(0, 0);
        for (std::size_t place = 0; place < m.size(); ++place) {
            const std::size_t i = ranks.rowAt(place);
            sum += static_cast<double>(m.mass[i]) * Vec2(m.vx[i], m.vy[i]);
        }
        return sum;
    });
}

std::size_t escaped(const World& world) {
    const Vec2 half = world.config().size / 2;
    return world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        std::size_t count = 0;
        for (std::size_t i = 0; i < m.size(); ++i) {
            count += !(std::abs(m.x[i]) <= half.x() && std::abs(m.y[i]) <= half.y());
        }
        return count;
    });
}

Overlap overlap(const World& world) {
    return world.visitBodies([&]<class Real>(const BodyView<Real>& bodies) {
        const auto& m = bodies.moving;
        const auto& f = bodies.fixed;
        auto partitioner = makePartitioner<Real>(Quadtree{}, world.config().size);
        partitioner->update(bodies, Real(1), Real(0));
        Overlap result;
        const auto add = [&](Real dx, Real dy, Real reachX, Real reachY) {
            const double depth =
                static_cast<double>(leastPenetration(dx, dy, reachX, reachY).depth);
            ++result.pairs;
            result.mean += depth;
            result.max = std::max(result.max, depth);
        };
        NarrowPhase<Real> narrowPhase;
        narrowPhase.find(
            bodies, partitioner->partition(),
            [&](MovingPair p) {
                add(m.x[p.b] - m.x[p.a], m.y[p.b] - m.y[p.a], m.halfWidth[p.a] + m.halfWidth[p.b],
                    m.halfHeight[p.a] + m.halfHeight[p.b]);
            },
            [&](StaticPair p) {
                add(f.x[p.fixed] - m.x[p.a], f.y[p.fixed] - m.y[p.a],
                    m.halfWidth[p.a] + f.halfWidth[p.fixed],
                    m.halfHeight[p.a] + f.halfHeight[p.fixed]);
            });
        if (result.pairs > 0) result.mean /= double(result.pairs);
        return result;
    });
}

}  // namespace quadrille
