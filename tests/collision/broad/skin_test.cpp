// A tree with a skin is kept while bodies move; no pair may be missed meanwhile.

#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <string>

#include <quadrille/partitioner_config.hpp>

#include "collision/broad/partitioner.hpp"
#include "collision/pairs/narrow_phase.hpp"
#include "collision/random_scene.hpp"
#include "collision/support.hpp"
#include "core/world_access.hpp"
#include "partition_checks.hpp"
#include "reals.hpp"
#include "sanitized.hpp"

namespace quadrille {
namespace {

using Skin = SemiStaticQuadtree::Skin;

constexpr double dt = 1.0 / 60;

/// The bodies as a law moves them, past the world: nobody counts that as an edit.
template <class Real>
LawBodies<Real> lawBodies(World& world) {
    return WorldAccess::store(world).advance<Real>({});
}

template <class Real>
void advance(World& world) {
    const auto m = lawBodies<Real>(world).moving;
    for (std::size_t i = 0; i < m.size(); ++i) {
        m.x[i] += m.vx[i] * Real(dt);
        m.y[i] += m.vy[i] * Real(dt);
    }
}

template <class Real>
class SkinTest : public testing::Test {
  protected:
    /// Partitioner and narrow phase of one run, which live as long as those of a simulation.
    struct Run {
        std::unique_ptr<Partitioner<Real>> partitioner;
        NarrowPhase<Real> narrowPhase;
        int steps = 0;
        int builds = 0;

        Run(const SemiStaticQuadtree& config, const Vec2& worldSize)
            : partitioner(makePartitioner<Real>(config, worldSize)) {}

        /// Updates, and says which pairs are missed or repeated.
        std::string update(const BodyView<Real>& bodies) {
            ++steps;
            builds += quadrille::update(*partitioner, bodies, dt);
            return difference(foundPairs(narrowPhase, bodies, partitioner->partition()),
                              overlappingPairs(Boxes<Real>(bodies)));
        }
    };

    static World scene(SceneKind kind, std::uint64_t seed, int most, double speed) {
        World world = randomScene(kind, seed, most, speed);
        world.setPrecision(precisionOf<Real>);
        return world;
    }
};

TYPED_TEST_SUITE(SkinTest, Reals, RealNames);

TYPED_TEST(SkinTest, NoPairIsMissedWhileBodiesMove) {
    using Real = TypeParam;
    for (const double width : {0.0, 1e-30, 1e-3, 0.1, 1.0, 10.0, 300.0}) {
        for (const SceneKind kind : sceneKinds) {
            for (std::uint64_t seed = 0; seed < 5; seed += sanitized ? 2 : 1) {
                const double speed = std::pow(10, double(seed));  // 1 to 10,000 px/s
                SCOPED_TRACE(std::string(name(kind)) + ", skin " + std::to_string(width) +
                             ", seed " + std::to_string(seed));
                World world = this->scene(kind, seed, 60, speed);
                typename TestFixture::Run run(SemiStaticQuadtree{8, 6, Skin{width}},
                                              world.config().size);
                const auto bodies = world.template bodies<Real>();
                for (int step = 0; step < (sanitized ? 12 : 30); ++step) {
                    advance<Real>(world);
                    ASSERT_EQ(run.update(bodies), "") << "step " << step;
                }
            }
        }
    }
}

TYPED_TEST(SkinTest, NoPairIsMissedWhenBodiesJump) {
    // As a law moves them that pushes overlaps apart.
    using Real = TypeParam;
    for (const double width : {0.0, 0.5, 20.0}) {
        for (std::uint64_t seed = 100; seed < 100 + scenesOf(25); ++seed) {
            SCOPED_TRACE("skin " + std::to_string(width) + ", seed " + std::to_string(seed));
            Random random(seed);
            World world = this->scene(sceneKinds[seed % sceneKinds.size()], seed, 50, 20);
            typename TestFixture::Run run(SemiStaticQuadtree{8, 6, Skin{width}},
                                          world.config().size);
            const auto bodies = world.template bodies<Real>();
            const auto m = lawBodies<Real>(world).moving;
            for (int step = 0; step < 60; ++step) {
                advance<Real>(world);
                if (m.size() > 1 && random.integer(0, 3) == 0) {
                    const auto i = static_cast<std::size_t>(random.integer(0, m.size() - 1));
                    const auto k = static_cast<std::size_t>(random.integer(0, m.size() - 1));
                    // Right onto another, or just as far as the skin allows, or very far.
                    const auto skin = static_cast<double>(run.partitioner->partition().margin);
                    const double far[] = {0.0, skin, 1.001 * skin, 1e4};
                    const double jump = far[random.integer(0, 3)];
                    if (jump == 0) {
                        m.x[i] = m.x[k];
                        m.y[i] = m.y[k];
                    } else {
                        m.x[i] += static_cast<Real>(random.sign() * jump);
                        m.y[i] += static_cast<Real>(random.sign() * jump);
                    }
                }
                ASSERT_EQ(run.update(bodies), "") << "step " << step;
            }
        }
    }
}

TYPED_TEST(SkinTest, NoPairIsMissedWhenBodiesAreEditedMadeAndDestroyed) {
    using Real = TypeParam;
    for (const double width : {0.0, 5.0, 1000.0}) {
        for (std::uint64_t seed = 200; seed < 200 + scenesOf(15); ++seed) {
            SCOPED_TRACE("skin " + std::to_string(width) + ", seed " + std::to_string(seed));
            Random random(seed);
            World world = this->scene(sceneKinds[seed % sceneKinds.size()], seed, 50, 20);
            typename TestFixture::Run run(SemiStaticQuadtree{8, 6, Skin{width}},
                                          world.config().size);
            for (int step = 0; step < 60; ++step) {
                advance<Real>(world);
                const Vec2 place(random.uniform(-100, 100), random.uniform(-60, 60));
                const Entity any = world.at(static_cast<std::uint32_t>(random.integer(0, 40)));
                switch (random.integer(0, 9)) {
                    case 0:
                        makeBox(world, place, moving(5, 5), {30, 30});
                        break;
                    case 1:
                        makeBox(world, place, fixed(), {30, 30});
                        break;
                    case 2:
                        if (world.alive(any)) world.destroy(any);
                        break;
                    case 3:
                        if (world.alive(any)) world.set(any, Transform{place});
                        break;
                    case 4:
                        if (world.alive(any)) world.set(any, BoxCollider{{50, 50}});
                        break;
                    case 5:
                        if (world.alive(any)) world.set(any, fixed());
                        break;
                    default:
                        break;
                }
                world.flush();
                ASSERT_EQ(run.update(world.template bodies<Real>()), "") << "step " << step;
            }
        }
    }
}

TYPED_TEST(SkinTest, NoPairIsMissedAmongLargeSlowBoxesThatAlmostTouch) {
    // Boxes some units of the last place apart that move by less than one: the skin may then be
    // thinner than what rounding does to a sum of half extents.
    using Real = TypeParam;
    constexpr double epsilon = std::numeric_limits<Real>::epsilon();
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        World world({.size = {4096, 4096}});
        world.setPrecision(precisionOf<Real>);
        const double ulp = 1000 * epsilon;
        const double skin = ulp * std::pow(10, random.uniform(-3, 0.3));
        // Close to the origin, where positions are finer than sizes.
        const double width = random.uniform(500, 1000);
        const Vec2 size(width, random.uniform(500, 1000));
        const double near = random.uniform(-2, 2) * ulp;
        const double far = width + random.uniform(-3, 3) * ulp;
        const auto body = [&] { return moving(random.uniform(-0.3, 0.3) * skin / dt); };
        makeBox(world, {near, 0}, body(), size);
        makeBox(world, {far, 0}, body(), size);
        makeBox(world, {near - width, 0}, body(), size);
        const bool automatic = seed % 2 == 0;
        typename TestFixture::Run run(SemiStaticQuadtree{10, 20, Skin{automatic ? 0 : skin}},
                                      world.config().size);
        const auto bodies = world.template bodies<Real>();
        for (int step = 0; step < 12; ++step) {
            ASSERT_EQ(run.update(bodies), "")
                << "step " << step << ", skin " << run.partitioner->partition().margin;
            advance<Real>(world);
        }
    }
}

TYPED_TEST(SkinTest, SlowBodiesKeepTheirTree) {
    // 0.5 px of skin at 6 px/s or less is left after 5 steps at the earliest.
    using Real = TypeParam;
    World world = this->scene(SceneKind::Uniform, 7, 120, 6);
    typename TestFixture::Run fixedSkin(SemiStaticQuadtree{8, 6, Skin{0.5}}, world.config().size);
    typename TestFixture::Run chosen(SemiStaticQuadtree{8, 6}, world.config().size);
    const auto bodies = world.template bodies<Real>();
    ASSERT_GT(bodies.moving.size(), 20u);
    for (int step = 0; step < 200; ++step) {
        advance<Real>(world);
        ASSERT_EQ(fixedSkin.update(bodies), "") << "step " << step;
        ASSERT_EQ(chosen.update(bodies), "") << "step " << step;
    }
    EXPECT_LE(fixedSkin.builds, 200 / 5 + 1);
    EXPECT_GE(fixedSkin.builds, 30);
    EXPECT_LT(chosen.builds, 60);
}

TYPED_TEST(SkinTest, BodiesAtRestKeepTheirTreeForEver) {
    using Real = TypeParam;
    for (const double width : {0.0, 0.5}) {
        World world = this->scene(SceneKind::Clustered, 8, 80, 0);
        typename TestFixture::Run run(SemiStaticQuadtree{8, 6, Skin{width}}, world.config().size);
        for (int step = 0; step < 50; ++step) {
            ASSERT_EQ(run.update(world.template bodies<Real>()), "") << "step " << step;
        }
        EXPECT_EQ(run.builds, 1);
    }
}

TYPED_TEST(SkinTest, ATreeThatIsKeptStaysWellFormed) {
    using Real = TypeParam;
    World world = this->scene(SceneKind::Uniform, 9, 100, 20);
    typename TestFixture::Run run(SemiStaticQuadtree{8, 6, Skin{2}}, world.config().size);
    const auto bodies = world.template bodies<Real>();
    for (int step = 0; step < 50; ++step) {
        advance<Real>(world);
        const int builds = run.builds;
        ASSERT_EQ(run.update(bodies), "");
        if (run.builds == builds) continue;
        ASSERT_EQ(faultOfCells(bodies, run.partitioner->partition()), "");
        ASSERT_EQ(faultOfTree(bodies, run.partitioner->partition(), 8, 6), "");
    }
}

}  // namespace
}  // namespace quadrille
