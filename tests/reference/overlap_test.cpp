#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

#include "reference/oracle.hpp"
#include "support.hpp"

// Boxes that overlap: accuracy.md, sections 5 and 8 (Bannerman et al., arXiv:1211.6718).
namespace quadrille::reference {
namespace {

TEST(Overlap, AtTheSamePlaceTheySeparateAlongX) {
    for (const double sense : {1.0, -1.0}) {
        Oracle oracle({{.velocity = {sense, 0.25}}, {.velocity = {-sense, -0.25}}});
        const double before = energy(oracle.state());
        oracle.runUntil(3);
        const auto state = oracle.state();
        ASSERT_TRUE(state[0].position.allFinite() && state[1].position.allFinite());
        EXPECT_EQ(energy(state), before);
        EXPECT_LT(state[0].position.x(), state[1].position.x()) << "the lower id goes left";
        EXPECT_LT(overlap(state[0], state[1]), 0);
    }
}

TEST(Overlap, AtTheSamePlaceWithoutRelativeMotionNothingHappens) {
    Oracle oracle({{.velocity = {1, 2}}, {.velocity = {1, 2}}});
    oracle.runUntil(10);
    EXPECT_TRUE(oracle.events().empty());
    EXPECT_EQ(oracle.state()[0].position, Vec2(10, 20));
    EXPECT_EQ(oracle.state()[1].position, Vec2(10, 20));
}

TEST(Overlap, DeepOnesPartAlongTheLeastAxis) {
    // 1 px deep along x, 3 along y; unequal and equal masses.
    for (const double mass : {1.0, 5.0}) {
        const std::vector<Box> boxes{
            {.position = {0, 0}, .velocity = {1, 1}, .size = {4, 4}},
            {.position = {3, 1}, .velocity = {-1, -1}, .size = {4, 4}, .mass = mass}};
        Oracle oracle(boxes);
        double last = overlap(boxes[0], boxes[1]);
        for (int slice = 1; slice <= 40; ++slice) {
            oracle.runUntil(slice * 0.05);
            const auto state = oracle.state();
            const double now = overlap(state[0], state[1]);
            EXPECT_LT(now, last);
            last = now;
        }
        ASSERT_EQ(oracle.events().size(), 1u);
        EXPECT_EQ(oracle.events()[0].axis, 1);
        EXPECT_EQ(oracle.events()[0].time, 0);
        EXPECT_NEAR(energy(oracle.state()), energy(boxes), 1e-14);
        EXPECT_NEAR((momentum(oracle.state()) - momentum(boxes)).norm(), 0, 1e-14);
    }
}

TEST(Overlap, ThatPartsAlreadyIsNoCollision) {
    Oracle oracle({{.velocity = {-1, 0}, .size = {4, 4}},
                   {.position = {3, 0}, .velocity = {1, 0}, .size = {4, 4}}});
    oracle.runUntil(5);
    EXPECT_TRUE(oracle.events().empty());
}

TEST(Overlap, OfACrowdEndsWithoutLossOfEnergy) {
    std::vector<Box> boxes = mixture(60, 7);
    for (int i = 0; i < 30; ++i) {  // a copy on top of every second box
        Box copy = boxes[std::size_t(4 + 2 * i)];
        copy.position += Vec2(0.125, 0.0625);
        copy.velocity = Vec2(-copy.velocity.y(), copy.velocity.x());
        boxes.push_back(copy);
    }
    Oracle oracle(boxes);
    oracle.runUntil(10);
    EXPECT_NEAR(energy(oracle.state()) / energy(boxes), 1, 1e-12);
    EXPECT_LE(largestOverlap(oracle.state()), 1e-10);
}

TEST(Overlap, NeverArisesBetweenUnequalBoxes) {
    const std::vector<Box> boxes = mixture(120, 1);
    Oracle oracle(boxes);
    for (int slice = 1; slice <= 40; ++slice) {
        oracle.runUntil(slice * 0.5);
        EXPECT_LE(largestOverlap(oracle.state()), 1e-10);
    }
    EXPECT_NEAR(energy(oracle.state()) / energy(boxes), 1, 1e-11);
    EXPECT_GT(oracle.events().size(), 1000u);
}

}  // namespace
}  // namespace quadrille::reference
