#include "accuracy/virial.hpp"

namespace quadrille::accuracy {

VirialBalance::VirialBalance(const World& world) {
    world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        const auto& f = bodies.fixed;
        for (std::size_t i = 0; i < m.size(); ++i) {
            moving_.push_back({.half = Vec2(m.halfWidth[i], m.halfHeight[i]),
                               .mass = static_cast<double>(m.mass[i])});
        }
        for (std::size_t k = 0; k < f.size(); ++k) {
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
        for (std::size_t i = 0; i < moving_.size(); ++i) {
            const Vec2 v(m.vx[i], m.vy[i]);
            velocities_[i] = v;
            virialNow_ += moving_[i].mass * Vec2(m.x[i], m.y[i]).cwiseProduct(v);
            twiceKinetic_ += moving_[i].mass * v.cwiseProduct(v);
        }
    });
}

void VirialBalance::collide(const Contact& contact) {
    if (!contact.collided) return;
    const auto a = static_cast<std::size_t>(contact.rowA);
    for (int k = 0; k < 2; ++k) {
        const double sense = contact.normal[k];
        if (sense == 0) continue;
        double& va = velocities_[a][k];
        if (contact.rowB < 0) {
            const Body& wall = fixed_[static_cast<std::size_t>(-1 - contact.rowB)];
            const double approach = sense * va;
            if (!(approach > 0)) continue;
            const double impulse = 2 * moving_[a].mass * approach;
            const double reach = moving_[a].half[k] + wall.half[k];
            impulses_[k] += impulse * (reach - sense * wall.position[k]);
            va = -va;
        } else {
            const auto b = static_cast<std::size_t>(contact.rowB);
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
