#include "collision/rules/double_double.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace quadrille {
namespace {

const double tiny = std::ldexp(1.0, -60);

TEST(DoubleDouble, ASumOfTwoNumbersKeepsAllDigits) {
    for (const double sign : {1.0, -1.0}) {
        for (const DoubleDouble& sum : {twoSum(1, sign * tiny), twoSum(sign * tiny, 1)}) {
            EXPECT_EQ(sum.high, 1);
            EXPECT_EQ(sum.low, sign * tiny);
        }
    }
}

TEST(DoubleDouble, AProductOfTwoNumbersKeepsAllDigits) {
    const double a = 1 + std::ldexp(1.0, -30);
    const DoubleDouble product = twoProduct(a, -a);
    EXPECT_EQ(product.high, -1 - std::ldexp(1.0, -29));
    EXPECT_EQ(product.low, -tiny);
}

TEST(DoubleDouble, WhatIsAddedComesOffAgain) {
    const DoubleDouble a{1, tiny};
    const DoubleDouble far = a + DoubleDouble{1e5, 3 * tiny};
    EXPECT_EQ(far.high, 100'001);
    const DoubleDouble back = far - DoubleDouble{1e5, 0};
    EXPECT_EQ(back.high, 1);
    EXPECT_EQ(back.low, 4 * tiny);
    const DoubleDouble half = 0.5 * back;
    EXPECT_EQ(half.high, 0.5);
    EXPECT_EQ(half.low, 2 * tiny);
}

}  // namespace
}  // namespace quadrille
