// When a node of the quadtree is a leaf: the rule that every builder of a tree goes by.

#include "collision/rules/leaf_rule.hpp"

#include <cstdint>
#include <gtest/gtest.h>

namespace quadrille {
namespace {

TEST(LeafRule, ANodeOfFewBodiesIsALeaf) {
    EXPECT_TRUE(isLeaf(0, 1, 5, false));
    EXPECT_TRUE(isLeaf(20, 20, 5, false));
    EXPECT_FALSE(isLeaf(21, 20, 5, false));
}

TEST(LeafRule, ASingleFineCellIsALeafHoweverFull) {
    EXPECT_TRUE(isLeaf(1'000'000, 1, 0, false));
    EXPECT_FALSE(isLeaf(1'000'000, 1, 1, false));
}

TEST(LeafRule, ANodeThatAllItsBodiesCoverIsALeaf) { EXPECT_TRUE(isLeaf(1'000'000, 1, 15, true)); }

TEST(LeafRule, ABodyCoversANodeIfItTouchesTheFirstAndTheLastFineCellOnBothAxes) {
    constexpr std::uint32_t x = 8;
    constexpr std::uint32_t y = 16;
    constexpr int shift = 2;  // fine cells 8..11 by 16..19
    EXPECT_TRUE(coversNode({8, 16, 11, 19}, x, y, shift));
    EXPECT_TRUE(coversNode({0, 0, 65535, 65535}, x, y, shift));
    EXPECT_FALSE(coversNode({9, 16, 11, 19}, x, y, shift));
    EXPECT_FALSE(coversNode({8, 17, 11, 19}, x, y, shift));
    EXPECT_FALSE(coversNode({8, 16, 10, 19}, x, y, shift));
    EXPECT_FALSE(coversNode({8, 16, 11, 18}, x, y, shift));
    // The largest node, and the smallest, which every body in it covers.
    EXPECT_TRUE(coversNode({0, 0, 32767, 32767}, 0, 0, 15));
    EXPECT_FALSE(coversNode({0, 0, 32767, 32766}, 0, 0, 15));
    EXPECT_TRUE(coversNode({7, 7, 7, 7}, 7, 7, 0));
}

}  // namespace
}  // namespace quadrille
