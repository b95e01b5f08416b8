#include "statistics/gas.hpp"

#include <algorithm>
#include <cmath>

namespace quadrille::accuracy {

namespace {

/// A lattice, each square moved at random within its cell, so that nothing starts with ties;
/// velocities are a random sign times 2 to 5, those of the report's balanced scene.
World makeWorld(const GasConfig& config, double length) {
    World world({.size = {length, length}, .seed = config.seed});
    world.addWalls({.thickness = 50});
    Random& random = world.random();
    const double cell = length / config.squaresPerSide;
    const double room = (cell - Gas::side) / 2;
    for (int row = 0; row < config.squaresPerSide; ++row) {
        for (int column = 0; column < config.squaresPerSide; ++column) {
            Vec2 place((column + 0.5) * cell - length / 2, (row + 0.5) * cell - length / 2);
            Vec2 velocity;
            for (int k = 0; k < 2; ++k) {
                place[k] += random.uniform(-room, room);
                velocity[k] = random.sign() * static_cast<double>(random.integer(2, 5));
            }
            world.add(world.create(), Transform{place}, BoxCollider{{Gas::side, Gas::side}},
                      PhysicsBody{velocity});
        }
    }
    return world;
}

std::vector<Vec2> velocitiesOf(const World& world) {
    return world.visitBodies([](const auto& bodies) {
        const auto& m = bodies.moving;
        std::vector<Vec2> velocities;
        for (std::size_t i = 0; i < m.size(); ++i) velocities.emplace_back(m.vx[i], m.vy[i]);
        return velocities;
    });
}

}  // namespace

Gas::Gas(const GasConfig& config)
    : length_(config.squaresPerSide * side / std::sqrt(config.filling)),
      dt_(config.dt),
      sim_(makeWorld(config, length_),
           {.law = config.law, .precision = config.precision, .step = {.dt = config.dt}}),
      velocities_(velocitiesOf(sim_.world())) {}

bool Gas::agreesWithWorld() const { return velocities_ == velocitiesOf(sim_.world()); }

/// Follows the velocities from hit to hit: equal masses exchange them, walls turn them.
void Gas::count(const Contact& contact) {
    if (!contact.collided) return;
    Vec2& a = velocities_[static_cast<std::size_t>(contact.numberA)];
    for (int k = 0; k < 2; ++k) {
        if (contact.normal[k] == 0) continue;
        if (contact.numberB < 0) {
            if (!(a[k] * contact.normal[k] > 0)) continue;
            tally_.wallHits[k] += 1;
            tally_.wallImpulse[k] += 2 * std::abs(a[k]);
            a[k] = -a[k];
        } else {
            Vec2& b = velocities_[static_cast<std::size_t>(contact.numberB)];
            if (!((a[k] - b[k]) * contact.normal[k] > 0)) continue;
            tally_.pairHits[k] += 1;
            tally_.pairVirial[k] += std::abs(a[k] - b[k]) * side;
            std::swap(a[k], b[k]);
        }
    }
}

Vec2 Gas::moment() const {
    return sim_.world().visitBodies([](const auto& bodies) {
        const auto& m = bodies.moving;
        Vec2 sum(0, 0);
        for (std::size_t i = 0; i < m.size(); ++i) {
            sum += Vec2(m.x[i], m.y[i]).cwiseProduct(Vec2(m.vx[i], m.vy[i]));
        }
        return sum;
    });
}

GasTally Gas::run(double seconds) {
    if (sim_.stepsDone() == 0) sim_.onContact([this](const Contact& c) { count(c); });
    tally_ = {};
    const auto steps = static_cast<std::uint64_t>(std::llround(seconds / dt_));
    const Vec2 before = moment();
    sim_.run(steps);
    tally_.time = static_cast<double>(steps) * dt_;
    tally_.momentChange = moment() - before;
    return tally_;
}

Vec2 Gas::twiceEnergy() const {
    Vec2 sum(0, 0);
    for (const Vec2& v : velocities_) sum += v.cwiseAbs2();
    return sum;
}

Vec2 meanRelativeSpeed(const std::vector<Vec2>& velocities) {
    const auto n = static_cast<double>(velocities.size());
    Vec2 mean;
    for (int k = 0; k < 2; ++k) {
        std::vector<double> speeds;
        for (const Vec2& v : velocities) speeds.push_back(std::abs(v[k]));
        std::sort(speeds.begin(), speeds.end());
        // Over the signs, the mean of |+-a +-b| is the greater of a and b.
        double sum = 0;
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            sum += speeds[i] * static_cast<double>(i);
        }
        mean[k] = sum / (n * (n - 1) / 2);
    }
    return mean;
}

Estimate estimate(const std::vector<double>& blocks) {
    const auto n = static_cast<double>(blocks.size());
    Estimate result;
    for (const double b : blocks) result.mean += b / n;
    double squares = 0;
    for (const double b : blocks) squares += (b - result.mean) * (b - result.mean);
    result.error = std::sqrt(squares / (n - 1) / n);
    return result;
}

}  // namespace quadrille::accuracy
