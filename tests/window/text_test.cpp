#include "app/window/text.hpp"

#include <gtest/gtest.h>

namespace quadrille::app {
namespace {

TEST(Text, GroupsDigits) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1,000");
    EXPECT_EQ(grouped(1234567), "1,234,567");
    EXPECT_EQ(grouped(~0ull), "18,446,744,073,709,551,615");
}

TEST(Text, NamesSpeeds) {
    EXPECT_EQ(speedLabel(0.25), "x 1/4");
    EXPECT_EQ(speedLabel(1), "x 1");
    EXPECT_EQ(speedLabel(8), "x 8");
    EXPECT_EQ(speedLabel(0), "as fast as it can");
}

TEST(Text, CompactNumbersHaveThreeDigits) {
    EXPECT_EQ(compact(0), "0");
    EXPECT_EQ(compact(0.012345), "0.0123");
    EXPECT_EQ(compact(12.345), "12.3");
    EXPECT_EQ(compact(999.4), "999");
    EXPECT_EQ(compact(999.6), "1,000");
    EXPECT_EQ(compact(12345), "12,300");
    EXPECT_EQ(compact(-1999999), "-2,000,000");
    EXPECT_EQ(compact(1.5e15), "1.5e+15");
}

}  // namespace
}  // namespace quadrille::app
