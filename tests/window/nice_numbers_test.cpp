#include "app/window/nice_numbers.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace quadrille::app {
namespace {

TEST(NiceCeiling, IsTheNextOfOneTwoAndFive) {
    EXPECT_DOUBLE_EQ(niceCeiling(1), 1);
    EXPECT_DOUBLE_EQ(niceCeiling(1.01), 2);
    EXPECT_DOUBLE_EQ(niceCeiling(2.5), 5);
    EXPECT_DOUBLE_EQ(niceCeiling(5.1), 10);
    EXPECT_DOUBLE_EQ(niceCeiling(0.03), 0.05);
    EXPECT_DOUBLE_EQ(niceCeiling(7300), 10000);
    EXPECT_DOUBLE_EQ(niceCeiling(1e-9), 1e-9);
}

TEST(NiceCeiling, OfWhatIsNotAboveZeroIsZero) {
    EXPECT_EQ(niceCeiling(0), 0);
    EXPECT_EQ(niceCeiling(-3), 0);
}

TEST(Percentile, IsTheValueThatTheShareIsNotAbove) {
    std::vector<float> values = {5, 1, 4, 2, 3};
    EXPECT_EQ(percentile(values, 1), 5);
    EXPECT_EQ(percentile(values, 0.8), 4);
    EXPECT_EQ(percentile(values, 0.79), 4);
    EXPECT_EQ(percentile(values, 0), 1);
    std::vector<float> none;
    EXPECT_EQ(percentile(none, 0.5), 0);
}

}  // namespace
}  // namespace quadrille::app
