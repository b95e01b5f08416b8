#include "accuracy/virial.hpp"

#include <quadrille/creation_ranks.hpp>

namespace quadrille::accuracy {

VirialBalance::VirialBalance(const World& world) {
    world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        const auto& f = bodies.fixed;
        const CreationRanks ranks(m.created, m.size());
        for (std::size_t place = 0; place < m.size(); ++place) {
            const std::size_t i = ranks.rowAt(place);
            moving_.push_back({.half = Vec2(m.halfWidth[i], m.halfHeight[i]),
                               .mass = static_cast<double>(m.mass[i])});
        }
        const CreationRanks ranksOfStatic(f.created, f.size());
        for (std::size_t place = 0; place < f.size(); ++place) {
            const std::size_t k = ranksOfStatic.rowAt(place);
            fixed_.push_back(
                {.half = Vec2(f.halfWidth[k], f.halfHeight[k]), .position = Vec2(f.x[k], f.y[k])});
        }
    });
    velocities_.resize(moving_.size());
    read(world);
    virialStart_ = virialNow_;
}

void VirialBalance::read(const World& world) {
    virialNow_ = Vec2(0, 0);
    twiceKinetic_ = Vec2(0, 0);
    world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        const CreationRanks ranks(m.created, m.size());
        for (std::size_t place = 0; place < moving_.size(); ++place) {
            const std::size_t i = ranks.rowAt(place);
            const Vec2 v(m.vx[i], m.vy[i]);
            const double mass = moving_[place].mass;
            velocities_[place] = v;
            virialNow_ += mass * Vec2(m.x[i], m.y[i]).cwiseProduct(v);
            twiceKinetic_ += mass * v.cwiseProduct(v);
        }
    });
}

void VirialBalance::collide(const Contact& contact) {
    if (!contact.collided) return;
    const auto a = static_cast<std::size_t>(contact.numberA);
    for (int k = 0; k < 2; ++k) {
        const double sense = contact.normal[k];
        if (sense == 0) continue;
        double& va = velocities_[a][k];
        if (contact.numberB < 0) {
            const Body& wall = fixed_[static_cast<std::size_t>(-1 - contact.numberB)];
            const double approach = sense * va;
            if (!(approach > 0)) continue;
            const double impulse = 2 * moving_[a].mass * approach;
            const double reach = moving_[a].half[k] + wall.half[k];
            impulses_[k] += impulse * (reach - sense * wall.position[k]);
            va = -va;
        } else {
            const auto b = static_cast<std::size_t>(contact.numberB);
            double& vb = velocities_[b][k];
            const double approach = sense * (va - vb);
            if (!(approach > 0)) continue;
            const double ma = moving_[a].mass;
            const double mb = moving_[b].mass;
            const double impulse = 2 * ma * mb / (ma + mb) * approach;
            impulses_[k] += impulse * (moving_[a].half[k] + moving_[b].half[k]);
            va -= sense * impulse / ma;
            vb += sense * impulse / mb;
        }
    }
}

void VirialBalance::finishStep(const World& world, double dt) {
    const Vec2 before = twiceKinetic_;
    read(world);
    motion_ += (before + twiceKinetic_) / 2 * dt;
}

Vec2 VirialBalance::residual() const {
    const Vec2 rest = virialNow_ - virialStart_ - motion_ - impulses_;
    return {motion_.x() > 0 ? rest.x() / motion_.x() : 0,
            motion_.y() > 0 ? rest.y() / motion_.y() : 0};
}

}  // namespace quadrille::accuracy
