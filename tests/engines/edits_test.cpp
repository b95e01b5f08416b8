// What was edited is all that an edit costs, and it does not show: a run that keeps its partition,
// candidate pairs and events through random edits has the bits of one that finds everything anew
// after each, of one that goes on from a snapshot, and of those with other partitioners or threads.

#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <vector>

#include <quadrille/names.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/snapshot.hpp>
#include <quadrille/state_hash.hpp>

#include "core/support.hpp"
#include "sanitized.hpp"

namespace quadrille {
namespace {

constexpr int steps = 40;

/// Boxes of few or many sizes between walls; in every other scene some overlap.
World scene(std::uint64_t seed) {
    World world({.size = {200, 200}, .seed = seed});
    world.addWalls();
    Random& random = world.random();
    const int side = 4 + static_cast<int>(seed % 6);
    const double pitch = 180.0 / side;
    for (int i = 0; i < side * side; ++i) {
        const Vec2 lattice(-90 + pitch * (i % side + 0.5), -90 + pitch * (i / side + 0.5));
        const Vec2 anywhere(random.uniform(-95, 95), random.uniform(-95, 95));
        const Vec2 velocity(random.uniform(-60, 60), random.uniform(-60, 60));
        const double size = seed % 3 == 0 ? 6 : random.uniform(3, 10);
        const double mass = seed % 5 < 3 ? 1 : random.uniform(0.1, 10);
        makeBody(world, seed % 2 == 0 ? lattice : anywhere, {.velocity = velocity, .mass = mass},
                 {size, size});
    }
    return world;
}

/// Writes what anybody may write into positions and velocities.
void edit(World& world, Random& random) {
    const auto any = [&] {
        return static_cast<std::size_t>(random.uniform(0, 1) *
                                        static_cast<double>(world.movingCount()));
    };
    world.editBodies([&]<class Real>(const MutableBodyView<Real>& bodies) {
        const auto& m = bodies.moving;
        const auto put = [&](std::size_t row, double x, double y) {
            m.x[row] = static_cast<Real>(x);
            m.y[row] = static_cast<Real>(y);
        };
        const auto push = [&](std::size_t row, double speed) {
            m.vx[row] = static_cast<Real>(random.uniform(-speed, speed));
            m.vy[row] = static_cast<Real>(random.uniform(-speed, speed));
        };
        const auto count = static_cast<int>(random.uniform(1, 5));
        for (int i = 0; i < count; ++i) {
            const std::size_t row = any();
            const std::size_t other = any();
            switch (static_cast<int>(random.uniform(0, 12))) {
                case 0:
                    put(row, random.uniform(-95, 95), random.uniform(-95, 95));
                    break;
                case 1:
                    put(row, m.x[other] + Real(1), m.y[other]);
                    break;
                case 2:
                    put(row, m.x[row] + Real(0.01), m.y[row]);
                    break;
                case 3:
                    put(row, random.uniform(150, 400), random.uniform(-400, 400));
                    break;
                case 4:
                    push(row, 5000);
                    break;
                case 5:
                    push(row, 0);
                    break;
                case 6:
                    m.vx[row] = m.vx[other];
                    break;
                default:
                    push(row, 60);
                    break;
            }
        }
    });
    const Entity entity =
        world.visitBodies([&](const auto& b) { return world.at(b.moving.entity[any()]); });
    auto body = world.get<PhysicsBody>(entity);
    body.velocity = {random.uniform(-60, 60), random.uniform(-60, 60)};
    world.set(entity, body);
}

enum class After : std::uint8_t { GoOn, BeginAnew, Restore };

/// The state after each step; about every second one is edited.
std::vector<std::uint64_t> runOf(std::uint64_t seed, const SimulationConfig& config,
                                 After after = After::GoOn) {
    Simulation sim(scene(seed), config);
    Random random(seed + 1000);
    std::vector<std::uint64_t> result;
    for (int i = 0; i < steps; ++i) {
        if (random.uniform(0, 1) < 0.5) edit(sim.world(), random);
        if (after == After::BeginAnew) sim.reconfigure(config);
        if (after == After::Restore && i % 3 == 0) sim.restore(sim.snapshot());
        sim.step();
        result.push_back(stateHash(sim.world()));
        result.push_back(config.law == Law::Continuous ? sim.world().movingCount() : 0);
    }
    return result;
}

class Edited : public testing::TestWithParam<std::tuple<Law, Precision>> {};

TEST_P(Edited, RunsHaveTheBitsOfOnesThatFindEverythingAnew) {
    const auto [law, precision] = GetParam();
    for (std::uint64_t seed = 0; seed < scenesOf(law == Law::Impulse ? 40 : 8); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        SimulationConfig config{
            .partitioner = SemiStaticQuadtree{},
            .law = law,
            .precision = precision,
            .step = {.gravity = seed % 4 < 2 ? Vec2(0, 0) : Vec2(seed % 8 < 4 ? 0 : 20, -60),
                     .restitution = seed % 3 == 0 ? 1 : 0.6}};
        const auto expected = runOf(seed, config, After::BeginAnew);
        EXPECT_EQ(runOf(seed, config), expected);
        EXPECT_EQ(runOf(seed, config, After::Restore), expected) << "from snapshots";
        for (const PartitionerConfig& partitioner :
             {PartitionerConfig(StaticGrid{}), PartitionerConfig(Quadtree{}),
              PartitionerConfig(BruteForce{}),
              PartitionerConfig(SemiStaticQuadtree{8, 4, SemiStaticQuadtree::Skin{3}})}) {
            config.partitioner = partitioner;
            EXPECT_EQ(runOf(seed, config), expected) << name(partitioner);
        }
        config.resolver = ResolverKind::Threads;
        config.threads = 3;
        EXPECT_EQ(runOf(seed, config), expected) << "on threads";
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, Edited,
                         testing::Combine(testing::Values(Law::Impulse, Law::Continuous),
                                          testing::Values(Precision::Double, Precision::Float)),
                         lawInPrecision);

}  // namespace
}  // namespace quadrille
