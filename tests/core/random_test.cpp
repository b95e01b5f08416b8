#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>

#include <quadrille/random.hpp>

namespace quadrille {
namespace {

constexpr auto lowest = std::numeric_limits<std::int64_t>::min();
constexpr auto highest = std::numeric_limits<std::int64_t>::max();

/// Sum of (counted - expected)^2 / expected over equally likely buckets.
template <std::size_t N>
double chiSquare(const std::array<int, N>& counts) {
    double total = 0;
    for (const int count : counts) total += count;
    double sum = 0;
    const double expected = total / double(N);
    for (const int count : counts) {
        sum += (count - expected) * (count - expected) / expected;
    }
    return sum;
}

TEST(Random, GeneratorIsTheOneOfTheStandard) {
    Random random(5489);
    EXPECT_EQ(random.engine()(), 14514284786278117030u);
    random.engine().discard(9998);
    EXPECT_EQ(random.engine()(), 9981545732273789042u);
}

// The numbers follow from the generator's outputs 14514284786278117030, 4620546740167642908,
// 13109570281517897720, 17462938647148434322, 355488278567739596, 7469126240319926998, ...
TEST(Random, NumbersOfASeedAreFixed) {
    Random uniform(5489);
    EXPECT_EQ(uniform.uniform(0, 1), 0.7868209548678019);
    EXPECT_EQ(uniform.uniform(0, 1), 0.2504803406880286);
    EXPECT_EQ(uniform.uniform(0, 1), 0.7106712289786554);
    Random integer(5489);
    for (const int expected : {-9, 5, -2, -9, 10, -6}) {
        EXPECT_EQ(integer.integer(-10, 10), expected);
    }
    Random sign(5489);
    for (const double expected : {-1., 1., -1., -1., 1., 1., 1., 1.}) {
        EXPECT_EQ(sign.sign(), expected);
    }
    Random mixed(42);
    EXPECT_EQ(mixed.uniform(-3, 5), 3.0412442636363117);
    EXPECT_EQ(mixed.uniform(-3, 5), 2.1122511508375794);
    for (const int expected : {23, 46, 31, 37}) EXPECT_EQ(mixed.integer(20, 50), expected);
}

TEST(Random, IntegerReachesBothBoundsAndNothingBeyond) {
    Random random(1);
    bool low = false;
    bool high = false;
    for (int i = 0; i < 1000; ++i) {
        const auto value = random.integer(-3, 4);
        ASSERT_GE(value, -3);
        ASSERT_LE(value, 4);
        low = low || value == -3;
        high = high || value == 4;
    }
    EXPECT_TRUE(low && high);
    EXPECT_EQ(random.integer(7, 7), 7);
    EXPECT_EQ(random.integer(lowest, lowest), lowest);
    EXPECT_EQ(random.integer(highest, highest), highest);
}

TEST(Random, IntegerTakesTheWidestRanges) {
    Random random(1);
    bool negative = false;
    bool positive = false;
    for (int i = 0; i < 1000; ++i) {
        const auto value = random.integer(lowest, highest);
        negative = negative || value < lowest / 2;
        positive = positive || value > highest / 2;
        ASSERT_LE(random.integer(lowest, 0), 0);
        ASSERT_GE(random.integer(-1, highest), -1);
        ASSERT_LT(random.integer(lowest, highest - 1), highest);
    }
    EXPECT_TRUE(negative && positive);
}

TEST(Random, IntegersAreEquallyLikely) {
    Random random(1);
    std::array<int, 10> counts{};
    for (int i = 0; i < 100'000; ++i) ++counts[static_cast<std::size_t>(random.integer(0, 9))];
    EXPECT_LT(chiSquare(counts), 40);  // 9 degrees of freedom: p < 1e-5
}

// Three quarters of the generator's range: without rejection, the first third of the numbers would
// come twice as often as the others.
TEST(Random, IntegersOfARangeThatDoesNotDivideTheGeneratorsAreEquallyLikely) {
    constexpr std::int64_t eighth = std::int64_t(1) << 61;
    Random random(1);
    std::array<int, 6> counts{};
    for (int i = 0; i < 60'000; ++i) {
        const auto value = random.integer(-3 * eighth, 3 * eighth - 1);
        ++counts[static_cast<std::size_t>((value >> 61) + 3)];
    }
    EXPECT_LT(chiSquare(counts), 32);  // 5 degrees of freedom: p < 1e-5
}

TEST(Random, UniformFillsTheRange) {
    Random random(1);
    std::array<int, 10> counts{};
    double sum = 0;
    for (int i = 0; i < 100'000; ++i) {
        const double value = random.uniform(-2, 3);
        ASSERT_GE(value, -2);
        ASSERT_LT(value, 3);
        ++counts[static_cast<std::size_t>((value + 2) * 2)];
        sum += value;
    }
    EXPECT_LT(chiSquare(counts), 40);
    EXPECT_NEAR(sum / 100'000, 0.5, 0.03);  // 6 standard errors
}

TEST(Random, UniformStaysBelowItsHighEndWhereRoundingCouldReachIt) {
    Random random(1);
    const double next = std::nextafter(1.0, 2.0);
    for (int i = 0; i < 100; ++i) {
        ASSERT_EQ(random.uniform(1, next), 1);
        const double value = random.uniform(1e16, 1e16 + 4);
        ASSERT_TRUE(value == 1e16 || value == 1e16 + 2) << value;
    }
}

TEST(Random, SignsAreEquallyLikely) {
    Random random(1);
    std::array<int, 2> counts{};
    for (int i = 0; i < 100'000; ++i) {
        const double sign = random.sign();
        ASSERT_TRUE(sign == 1 || sign == -1);
        ++counts[sign > 0];
    }
    EXPECT_LT(chiSquare(counts), 25);  // 1 degree of freedom: p < 1e-6
}

}  // namespace
}  // namespace quadrille
