#include "collision/continuous/path_sketches.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <vector>

#include <quadrille/random.hpp>

#include "collision/rules/next_event.hpp"
#include "plain_world.hpp"

// A sketch that leaves out a pair that meets loses a collision, which no other test need notice. So
// that cannot hide, pairs here only just touch: the search with sketches must find what the search
// without them does, far from the origin too, where single precision is coarse.

namespace quadrille {
namespace {

template <class RealType, class PathType>
struct Kind {
    using Real = RealType;
    using Path = PathType;
};
using Kinds = testing::Types<Kind<double, StraightPath>, Kind<double, FallingPath>,
                             Kind<float, StraightPath>, Kind<float, FallingPath>>;

template <class Kind>
class PathSketch : public testing::Test {};
TYPED_TEST_SUITE(PathSketch, Kinds);

constexpr double from = 2, to = 4;  // s
constexpr double fastest = 20;      // px/s
constexpr std::uint32_t bodies = 24;

/// Bodies around a place, each of which sets out at its own time, so fast that many meet; every
/// other one at an edge of the one before, give or take a last digit.
template <class Real, class Path>
void fill(PlainWorld<Real, Path>& world, Random& random, double place) {
    for (std::uint32_t i = 0; i < bodies; ++i) {
        PlainBox box{.x = place + random.uniform(-40, 40),
                     .y = -place + random.uniform(-40, 40),
                     .vx = random.uniform(-fastest, fastest),
                     .vy = random.uniform(-fastest, fastest),
                     .width = random.uniform(1, 6),
                     .height = random.uniform(1, 6)};
        const std::uint32_t row = world.add(box);
        auto& anchor = world.anchors[row];
        if (i % 2 == 1) {
            const auto& before = world.anchors[row - 1];
            anchor = before;
            anchor.x += static_cast<Real>((world.halfWidth[row] + world.halfWidth[row - 1]) *
                                          (1 + random.uniform(-1e-7, 1e-7)));
            anchor.vy = static_cast<Real>(-before.vy);
        }
        anchor.timeX = random.uniform(0, from);
        anchor.timeY = random.uniform(0, from);
        if (Path::falls && i % 5 == 0) world.rests[row] = axisY;
    }
    world.addStatic({.x = place, .y = -place, .width = 30, .height = 30});
}

auto keyOf(const PairEvent& e) { return std::tuple(e.time, e.a, e.b.bits, e.axes, e.release); }

TYPED_TEST(PathSketch, LeavesOutNoEvent) {
    using Real = typename TypeParam::Real;
    using Path = typename TypeParam::Path;
    Random random(91);
    std::size_t looked = 0;
    std::size_t near = 0;
    std::size_t events = 0;
    for (const double place : {0.0, 1e3, 3e5, 1e8}) {
        for (int round = 0; round < 40; ++round) {
            PlainWorld<Real, Path> world(Path::falls ? 30 : 0);
            fill(world, random, place);
            const auto motion = world.motion();
            for (std::uint32_t row = 0; row < bodies; ++row) motion.place(row, from);
            PathSketches<Real, Path> sketches;
            sketches.draw(motion, bodies,
                          {.from = from,
                           .to = to,
                           .farthest = place + 200,
                           .fastest = fastest + 60,
                           .largest = 15,
                           .gravity = Path::falls ? 30.0 : 0.0},
                          ThreadTeam::serial());
            for (std::uint32_t row = 0; row < bodies; ++row) {
                std::vector<BodyRef> others{BodyRef::fixed(0)};
                std::vector<MovingPair> pairs;
                for (std::uint32_t b = 0; b < bodies; ++b) {
                    if (b == row) continue;
                    others.push_back(BodyRef::moving(b));
                    pairs.push_back({row, b});
                }
                const double now = random.uniform(from, to);
                std::vector<PairEvent> expected;
                std::vector<PairEvent> found;
                findFor(motion, row, others, now, to, [&](auto e) { expected.push_back(e); });
                sketches.forEachNear(row, others, now, to, [&](std::span<const BodyRef> some) {
                    near += some.size();
                    findFor(motion, row, some, now, to, [&](auto e) { found.push_back(e); });
                });
                looked += others.size();
                events += expected.size();
                const auto countBetween = [&](auto&& collect) {
                    std::vector<PairEvent> all;
                    collect([&](MovingPair p) {
                        findBetween(motion, p.a, BodyRef::moving(p.b), from, to,
                                    [&](auto e) { all.push_back(e); });
                    });
                    return all;
                };
                const auto plain =
                    countBetween([&](auto&& f) { std::for_each(pairs.begin(), pairs.end(), f); });
                const auto sketched = countBetween([&](auto&& f) {
                    sketches.forEachNear(std::span<const MovingPair>(pairs), from, to, f);
                });
                ASSERT_EQ(found.size(), expected.size()) << place << " row " << row;
                ASSERT_EQ(sketched.size(), plain.size()) << place << " row " << row;
                for (std::size_t i = 0; i < found.size(); ++i) {
                    ASSERT_EQ(keyOf(found[i]), keyOf(expected[i]));
                }
                for (std::size_t i = 0; i < plain.size(); ++i) {
                    ASSERT_EQ(keyOf(sketched[i]), keyOf(plain[i]));
                }
            }
        }
    }
    EXPECT_GT(events, 500u);
    EXPECT_LT(near, looked) << "nothing was left out";
}

/// After an event the line of its body is another one.
TEST(PathSketch, IsDrawnAnew) {
    PlainWorld<double, StraightPath> world;
    world.add({.x = 0, .vx = 1});
    world.add({.x = 100, .vx = 1});
    const auto motion = world.motion();
    PathSketches<double, StraightPath> sketches;
    sketches.draw(motion, 2,
                  {.from = 0, .to = 10, .farthest = 300, .fastest = 20, .largest = 1, .gravity = 0},
                  ThreadTeam::serial());
    const BodyRef other = BodyRef::moving(1);
    const auto countNear = [&] {
        std::size_t count = 0;
        sketches.forEachNear(0, {&other, 1}, 0, 10, [&](auto some) { count += some.size(); });
        return count;
    };
    EXPECT_EQ(countNear(), 0u);
    motion.set(1, 0, 100, -19, 0);
    EXPECT_EQ(countNear(), 0u) << "as it was drawn";
    sketches.redraw(motion, 1);
    EXPECT_EQ(countNear(), 1u);
}

}  // namespace
}  // namespace quadrille
