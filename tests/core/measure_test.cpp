#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <quadrille/measure.hpp>
#include <quadrille/names.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/state_hash.hpp>
#include <quadrille/world.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

struct State {
    double x = 0, y = 0, vx = 0, vy = 0;
};

World worldOf(const std::vector<State>& states, Precision precision = Precision::Double) {
    World world;
    for (const State& s : states) makeBody(world, {s.x, s.y}, {.velocity = {s.vx, s.vy}});
    world.setPrecision(precision);
    return world;
}

std::uint64_t hashOf(const std::vector<State>& states, Precision precision = Precision::Double) {
    return stateHash(worldOf(states, precision));
}

/// For tests that hold in both precisions.
class InPrecision : public testing::TestWithParam<Precision> {};
INSTANTIATE_TEST_SUITE_P(Measure, InPrecision, testing::Values(Precision::Double, Precision::Float),
                         [](const auto& instance) { return std::string(name(instance.param)); });

// ---- state hash

TEST_P(InPrecision, HashOfTheSameStateIsTheSame) {
    const std::vector<State> states{{1, 2, 3, 4}, {5, 6, 7, 8}};
    EXPECT_EQ(hashOf(states, GetParam()), hashOf(states, GetParam()));
}

TEST_P(InPrecision, HashTakesMinusZeroForZero) {
    const State zero;
    const State minus{-0.0, -0.0, -0.0, -0.0};
    EXPECT_EQ(hashOf({zero, {1, 1, 1, 1}}, GetParam()), hashOf({minus, {1, 1, 1, 1}}, GetParam()));
}

TEST_P(InPrecision, HashSeesTheLastBitOfEveryNumber) {
    const std::vector<State> states{{1, 2, 3, 4}, {5, 6, 7, 8}};
    std::set<std::uint64_t> hashes{hashOf(states, GetParam())};
    const auto next = [](double value) {
        return GetParam() == Precision::Double
                   ? std::nextafter(value, infinity)
                   : double(std::nextafter(float(value), std::numeric_limits<float>::max()));
    };
    for (std::size_t body = 0; body < states.size(); ++body) {
        for (double State::*number : {&State::x, &State::y, &State::vx, &State::vy}) {
            auto changed = states;
            changed[body].*number = next(changed[body].*number);
            hashes.insert(hashOf(changed, GetParam()));
        }
    }
    EXPECT_EQ(hashes.size(), 9u);
}

TEST_P(InPrecision, HashSeesSignsAndOrder) {
    const State a{1, 2, 3, 4};
    const State b{5, 6, 7, 8};
    const std::set<std::uint64_t> hashes{
        hashOf({a, b}, GetParam()),
        hashOf({b, a}, GetParam()),
        hashOf({{1, 2, 3, -4}, b}, GetParam()),
        hashOf({{2, 1, 3, 4}, b}, GetParam()),
        hashOf({{3, 4, 1, 2}, b}, GetParam()),
        hashOf({{1, 2, 7, 8}, {5, 6, 3, 4}}, GetParam()),
    };
    EXPECT_EQ(hashes.size(), 6u);
}

TEST_P(InPrecision, HashSeesTheNumberOfBodiesAtRestInTheOrigin) {
    const State zero;
    const std::set<std::uint64_t> hashes{hashOf({}, GetParam()), hashOf({zero}, GetParam()),
                                         hashOf({zero, zero}, GetParam())};
    EXPECT_EQ(hashes.size(), 3u);
}

TEST(StateHash, IsOfMovingBodiesOnlyAndNotOfTheirIds) {
    World world;
    const Entity gone = makeBody(world, {9, 9});
    makeBody(world, {8, 8}, {.isStatic = true});
    world.create("bystander");
    world.destroy(gone);
    world.flush();
    makeBody(world, {1, 2}, {.velocity = {3, 4}});
    EXPECT_EQ(stateHash(world), hashOf({{1, 2, 3, 4}}));
}

// ---- energy and momentum

TEST_P(InPrecision, EnergyAndMomentumOfTwoBodies) {
    World world;
    makeBody(world, {10, 5}, {.velocity = {3, -4}, .mass = 2});
    makeBody(world, {-1, -2}, {.velocity = {1, 0}, .mass = 0.5});
    makeBody(world, {7, 7}, {.isStatic = true});
    world.setPrecision(GetParam());
    EXPECT_EQ(kineticEnergy(world), 2 * 12.5 + 0.5 * 0.5);
    EXPECT_EQ(momentum(world), Vec2(6.5, -8));
    // -g . x is 10 * 5 + 1 * 10 for the first body and 10 * -2 + 1 * -1 for the second.
    EXPECT_EQ(totalEnergy(world, {-1, -10}), 2 * (12.5 + 60) + 0.5 * (0.5 - 21));
    EXPECT_EQ(totalEnergy(world, {0, 0}), kineticEnergy(world));
}

TEST(Measure, EmptyWorldHasNothing) {
    const World world;
    EXPECT_EQ(kineticEnergy(world), 0);
    EXPECT_EQ(momentum(world), Vec2(0, 0));
    EXPECT_EQ(escaped(world), 0u);
    EXPECT_EQ(overlap(world).pairs, 0u);
    EXPECT_EQ(overlap(world).mean, 0);
}

TEST_P(InPrecision, EscapedAreTheCentresBeyondTheBorder) {
    World world({.size = {100, 50}});
    makeBody(world, {0, 0});
    makeBody(world, {50, 25});  // on the corner
    makeBody(world, {-50, -25});
    makeBody(world, {50.5, 0});   // right of it
    makeBody(world, {0, -25.5});  // below
    makeBody(world, {-1000, 1000});
    makeBody(world, {1000, 0}, {.isStatic = true});  // not a moving body
    world.setPrecision(GetParam());
    EXPECT_EQ(escaped(world), 3u);
}

// ---- overlap

TEST_P(InPrecision, OverlapIsMeasuredAlongTheAxisOfLeastPenetration) {
    World world;
    // Boxes of 2 x 4: the first two overlap by 1.5 x 1, the third only touches the first.
    makeBody(world, {0, 0});
    makeBody(world, {0.5, 3});
    makeBody(world, {-2, 0});
    // Overlaps a wall by 0.25 x 4; walls that overlap each other do not count.
    makeBody(world, {100, 0});
    makeBody(world, {101.75, 0}, {.isStatic = true});
    makeBody(world, {102, 0}, {.isStatic = true});
    world.setPrecision(GetParam());
    const Overlap result = overlap(world);
    EXPECT_EQ(result.pairs, 2u);
    EXPECT_EQ(result.max, 1);
    EXPECT_EQ(result.mean, (1 + 0.25) / 2);
}

TEST_P(InPrecision, OverlapOfEqualCentresIsTheSmallerSide) {
    World world;
    makeBody(world, {1, 1}, {}, {2, 6});
    makeBody(world, {1, 1}, {}, {4, 8});
    world.setPrecision(GetParam());
    EXPECT_EQ(overlap(world).pairs, 1u);
    EXPECT_EQ(overlap(world).max, 3);
}

TEST(Overlap, OfACrowdIsThatOfAllItsPairs) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        World world({.size = {200, 200}, .seed = seed});
        std::vector<Vec2> centres, sizes;
        for (int i = 0; i < 400; ++i) {
            Random& random = world.random();
            centres.emplace_back(random.uniform(-120, 120), random.uniform(-120, 120));
            sizes.emplace_back(random.uniform(1, 20), random.uniform(1, 20));
            makeBody(world, centres.back(), {}, sizes.back());
        }
        std::size_t pairs = 0;
        double most = 0;
        for (std::size_t i = 0; i < centres.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const Vec2 depth = (sizes[i] + sizes[j]) / 2 - (centres[i] - centres[j]).cwiseAbs();
                if (!(depth.minCoeff() > 0)) continue;
                ++pairs;
                most = std::max(most, depth.minCoeff());
            }
        }
        const Overlap result = overlap(world);
        EXPECT_EQ(result.pairs, pairs);
        EXPECT_NEAR(result.max, most, 1e-12);
    }
}

}  // namespace
}  // namespace quadrille
