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

}  // namespace
}  // namespace quadrille::app
