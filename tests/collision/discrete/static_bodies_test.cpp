// Static boxes and the law `impulse`: level seams change no speed, whatever the tiling, and nothing
// gets into a static box or out of the world, however it is pushed. Once a box stopped at every
// seam, and heaps pressed bodies through walls.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/measure.hpp>
#include <quadrille/names.hpp>
#include <quadrille/state_hash.hpp>

#include "collision/rules/impulse_contact.hpp"
#include "collision/support.hpp"
#include "collision/thread_checks.hpp"

namespace quadrille {
namespace {

class StaticBodies : public testing::TestWithParam<Precision> {
  protected:
    double epsilon() const {
        return GetParam() == Precision::Double ? double(std::numeric_limits<double>::epsilon())
                                               : double(std::numeric_limits<float>::epsilon());
    }
};

INSTANTIATE_TEST_SUITE_P(Precisions, StaticBodies,
                         testing::Values(Precision::Double, Precision::Float),
                         [](const auto& test) { return std::string(name(test.param)); });

// ---- seams

/// The four ways to lie on something: down, up, left and right.
struct Side {
    int along, across;  // axes
    double towards;     // in which sense across the surface lies
};
constexpr std::array sides = {Side{0, 1, -1}, Side{0, 1, 1}, Side{1, 0, -1}, Side{1, 0, 1}};

Vec2 vector(const Side& side, double along, double across) {
    Vec2 v;
    v[side.along] = along;
    v[side.across] = across;
    return v;
}

enum class Tiling { Equal, Narrow, Mixed };

/// Level tiles whose common surface is at `surface` across, from -60 to 400 along.
void layTiles(World& world, const Side& side, Tiling tiling, double surface, Random& random) {
    for (double from = -60; from < 400;) {
        const double width = tiling == Tiling::Equal    ? 20
                             : tiling == Tiling::Narrow ? 1.25
                                                        : random.uniform(0.7, 30);
        const double thickness = tiling == Tiling::Mixed ? random.uniform(3, 40) : 10;
        makeBox(world, vector(side, from + width / 2, surface + side.towards * thickness / 2),
                fixed(), vector(side, width, thickness));
        from += width;
    }
}

struct Slide {
    double dt, restitution, gap;
};

/// A box of 10 px slides over the tiles, or falls on them from a gap.
void expectSlides(const Slide& slide, const Side& side, Tiling tiling, Precision precision,
                  double epsilon) {
    Random random(77 + static_cast<std::uint64_t>(tiling));
    const double surface = tiling == Tiling::Mixed ? 123.4567 : 0;
    World world({.size = {1000, 1000}});
    layTiles(world, side, tiling, surface, random);
    const double level = surface - side.towards * (5 + slide.gap);
    constexpr double speed = 40;
    const Entity box =
        makeBox(world, vector(side, -40, level), {.velocity = vector(side, speed, 0)}, {10, 10});
    Simulation sim(std::move(world), {.law = Law::Impulse,
                                      .precision = precision,
                                      .step = {.dt = slide.dt,
                                               .gravity = vector(side, 0, side.towards * 200),
                                               .restitution = slide.restitution}});
    const auto steps = static_cast<int>(4 / slide.dt);
    const double rounding = 2000 * epsilon;
    for (int i = 1; i <= steps; ++i) {
        sim.step();
        ASSERT_EQ(velocityOf(sim, box)[side.along], speed) << "step " << i;
        const double depth = (positionOf(sim, box)[side.across] - surface) * side.towards + 5;
        ASSERT_LT(depth, rounding) << "step " << i;
    }
    ASSERT_NEAR(positionOf(sim, box)[side.along], -40 + speed * slide.dt * steps,
                steps * 200 * epsilon);
}

TEST_P(StaticBodies, LevelSeamsChangeNoSpeed) {
    for (const double dt : {1.0 / 20, 1.0 / 60, 1.0 / 64, 1.0 / 240}) {
        for (std::size_t k = 0; k < sides.size(); ++k) {
            for (const Tiling tiling : {Tiling::Equal, Tiling::Narrow, Tiling::Mixed}) {
                for (const Slide& slide :
                     {Slide{dt, 0, 0}, Slide{dt, 0.5, 0}, Slide{dt, 0, 20}, Slide{dt, 1, 20}}) {
                    SCOPED_TRACE("dt " + std::to_string(dt) + ", side " + std::to_string(k) +
                                 ", tiling " + std::to_string(int(tiling)) + ", restitution " +
                                 std::to_string(slide.restitution) + ", gap " +
                                 std::to_string(slide.gap));
                    expectSlides(slide, sides[k], tiling, GetParam(), epsilon());
                    if (HasFatalFailure()) return;
                }
            }
        }
    }
}

TEST_P(StaticBodies, ABoxSunkIntoLevelTilesIsLiftedOutWithoutAPush) {
    // Deeper in the tile that it leaves, or comes to, than it covers of it.
    for (const double along : {-5.03, -4.97, 0.0, 4.97, 5.03}) {
        SCOPED_TRACE(along);
        World world({.size = {400, 100}});
        makeBox(world, {-50, -5}, fixed(), {100, 10});
        makeBox(world, {50, -5}, fixed(), {100, 10});
        const Entity box = makeBox(world, {along, 4.9}, moving(20), {10, 10});
        Simulation sim(std::move(world), {.law = Law::Impulse,
                                          .precision = GetParam(),
                                          .step = {.gravity = {0, -200}, .restitution = 0}});
        sim.run(30);
        EXPECT_EQ(velocityOf(sim, box).x(), 20);
        EXPECT_NEAR(positionOf(sim, box).y(), 5, 2000 * epsilon());
    }
}

// ---- a contact that earlier ones have undone

TEST(UndoneContact, IsNoneWhenItsTurnComes) {
    double x[] = {0, 1.5}, y[] = {0, 0.25}, vx[] = {10, -10}, vy[] = {0, 0};
    const std::uint32_t entity[] = {0, 1};
    Bodies<double> bodies{};
    bodies.moving = {.x = x,
                     .y = y,
                     .vx = vx,
                     .vy = vy,
                     .halfWidth = {nullptr, 1},
                     .halfHeight = {nullptr, 1},
                     .mass = {nullptr, 1},
                     .entity = entity,
                     .created = {},
                     .anchors = nullptr,
                     .rests = nullptr};
    const StepParameters<double> step{
        .start = 0, .dt = 0.125, .gravityX = 0, .gravityY = 0, .restitution = 1};
    const auto contact = movingContact(bodies, 0, 1, step.dt);
    ASSERT_EQ(contact.axes, axisX);
    for (const Vec2& parted : {Vec2(2.5, 0.25), Vec2(1.5, 2)}) {
        x[1] = parted.x();
        y[1] = parted.y();
        EXPECT_FALSE(resolveContact(bodies, contact, step).collided());
        EXPECT_EQ(vx[0], 10);
        EXPECT_EQ(x[1], parted.x());
    }
    x[1] = 1.5;
    y[1] = 0.25;
    EXPECT_TRUE(resolveContact(bodies, contact, step).collided());
    EXPECT_EQ(vx[0], -10);
}

// ---- static boxes are final

/// The deepest that a moving body is in a static one.
double deepestInStatic(const World& world) {
    double deepest = 0;
    world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        const auto& f = bodies.fixed;
        for (std::size_t i = 0; i < m.size(); ++i) {
            for (std::size_t k = 0; k < f.size(); ++k) {
                const double x =
                    double(m.halfWidth[i]) + f.halfWidth[k] - std::abs(double(f.x[k]) - m.x[i]);
                const double y =
                    double(m.halfHeight[i]) + f.halfHeight[k] - std::abs(double(f.y[k]) - m.y[i]);
                deepest = std::max(deepest, std::min(x, y));
            }
        }
    });
    return deepest;
}

/// Boxes of 4 to 7 px that fill most of a closed room with pegs in it, and overlap nothing.
World crowdedRoom(std::uint64_t seed) {
    World world({.size = {200, 160}, .seed = seed});
    world.addWalls({.thickness = 40});
    Random random(seed);
    for (int i = -9; i < 9; ++i) {
        for (int j = -7; j < 7; ++j) {
            const Vec2 place(10 * i + 5 + random.uniform(-1, 1),
                             10 * j + 5 + random.uniform(-1, 1));
            const Vec2 size(random.uniform(4, 7), random.uniform(4, 7));
            if (random.uniform(0, 1) < 0.1) {
                makeBox(world, place, fixed(), size);
            } else {
                makeBox(world, place,
                        moving(random.uniform(-90, 90), random.uniform(-90, 90),
                               seed % 2 == 0 ? 1 : random.uniform(0.2, 5)),
                        size);
            }
        }
    }
    return world;
}

TEST_P(StaticBodies, NothingEntersThemAndNothingEscapes) {
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const double g = seed % 3 == 0 ? 0 : 300;
        Simulation sim(crowdedRoom(seed),
                       {.law = Law::Impulse,
                        .precision = GetParam(),
                        .step = {.gravity = {seed % 4 == 0 ? g : 0, seed % 4 == 0 ? 0 : -g},
                                 .restitution = seed % 5 == 0 ? 1 : 0.2 * double(seed % 5)}});
        ASSERT_LE(deepestInStatic(sim.world()), 0);
        for (int i = 0; i < 240; ++i) {
            sim.step();
            ASSERT_LT(deepestInStatic(sim.world()), 4000 * epsilon()) << "step " << i;
        }
        ASSERT_EQ(escaped(sim.world()), 0u);
    }
}

TEST_P(StaticBodies, AWallHoldsAgainstAHeavyPush) {
    // The heavy box pushes the light one by far more in a step than what is between it and the
    // wall.
    World world({.size = {400, 100}});
    makeBox(world, {20, 0}, fixed(), {10, 50});
    const Entity light = makeBox(world, {12.5, 0}, moving(0, 0, 1), {4, 4});
    const Entity heavy = makeBox(world, {8.2, 0}, moving(300, 0, 1000), {4, 4});
    Simulation sim(std::move(world),
                   {.law = Law::Impulse, .precision = GetParam(), .step = {.restitution = 0.5}});
    for (int i = 0; i < 30; ++i) {
        sim.step();
        ASSERT_LE(positionOf(sim, light).x(), 13 + 1000 * epsilon()) << "step " << i;
        ASSERT_LE(positionOf(sim, heavy).x(), 13 + 1000 * epsilon()) << "step " << i;
    }
}

TEST_P(StaticBodies, AHeapStaysInItsContainer) {
    // The fifth part of shared scene tall-heap: 400 boxes of 8 px, gravity 200, restitution .2.
    World world({.size = {96, 900}});
    world.addWalls({.thickness = 100});
    Random random(1);
    for (int i = 0; i < 400; ++i) {
        makeBox(world, {-43 + 9.5 * (i % 10), -440 + 12.0 * (i / 10)},
                moving(random.uniform(-20, 20), random.uniform(-20, 20)), {8, 8});
    }
    Simulation sim(std::move(world), {.law = Law::Impulse,
                                      .precision = GetParam(),
                                      .step = {.gravity = {0, -200}, .restitution = 0.2}});
    for (int i = 0; i < 600; ++i) {
        sim.step();
        ASSERT_LT(deepestInStatic(sim.world()), 8000 * epsilon()) << "step " << i;
    }
    EXPECT_EQ(escaped(sim.world()), 0u);
}

TEST_P(StaticBodies, ABoxWedgedBetweenTwoHasOneOutcome) {
    // It starts in both of them, with 3 px of room for its 4.
    std::vector<std::uint64_t> hashes;
    for (const PartitionerConfig& partitioner : completePartitioners) {
        World world({.size = {100, 100}});
        makeBox(world, {-6.5, 0}, fixed(), {10, 40});
        makeBox(world, {6.5, 0}, fixed(), {10, 40});
        const Entity box = makeBox(world, {0.1, 0}, moving(7, 3), {4, 4});
        Simulation sim(std::move(world), {.partitioner = partitioner,
                                          .law = Law::Impulse,
                                          .precision = GetParam(),
                                          .resolver = ResolverKind::Sequential});
        sim.run(120);
        EXPECT_LT(std::abs(positionOf(sim, box).x()), 1.01);
        EXPECT_EQ(std::abs(velocityOf(sim, box).x()), 7);
        EXPECT_EQ(velocityOf(sim, box).y(), 3);
        hashes.push_back(stateHash(sim.world()));
    }
    for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
}

TEST_P(StaticBodies, ThreadsKeepBodiesOutAsOneThreadDoes) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        expectTheSameOnThreads(
            [&] { return crowdedRoom(seed); },
            {.partitioner = completePartitioners[seed % completePartitioners.size()],
             .precision = GetParam(),
             .step = {.gravity = {0, -300}, .restitution = 0.4}},
            40, {1, 3, 16});
    }
}

}  // namespace
}  // namespace quadrille
