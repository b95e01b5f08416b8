#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "reference/lattice_oracle.hpp"
#include "reference/rational.hpp"
#include "support.hpp"

namespace quadrille::reference {
namespace {

TEST(Rational, ComparesExactlyWhereDoublesDoNot) {
    const std::int64_t big = INT64_MAX - 1;
    EXPECT_TRUE(Rational(big - 1, big) < Rational(big, big + 1));
    EXPECT_FALSE(Rational(big, big + 1) < Rational(big - 1, big));
    EXPECT_TRUE(Rational(1, -3) < Rational(0, 7));
    EXPECT_EQ(Rational(2, 4), Rational(-3, -6));
}

TEST(Rational, IsRoundedOnceToTheNearestDouble) {
    EXPECT_EQ(nearestDouble(Rational(1, 3), 0), 1.0 / 3);
    EXPECT_EQ(nearestDouble(Rational(-989, 120000), 0), -989.0 / 120000);
    EXPECT_EQ(nearestDouble(Rational(5, 1), -2), 1.25);
    EXPECT_EQ(nearestDouble(Rational(0, 5), 3), 0);
    const std::int64_t one = std::int64_t{1} << 53;
    EXPECT_EQ(nearestDouble(Rational(one + 1, 1), 0), double(one)) << "a tie goes to even";
    EXPECT_EQ(nearestDouble(Rational(2 * one + 2 + 1, 2), 0), double(one + 2)) << "just above it";
    // p/q exceeds the middle of two doubles by 2^-54/q only; the lower one is even.
    const std::int64_t p = 4569493441301475534;
    const std::int64_t q = 4611686018427400255;
    EXPECT_EQ(nearestDouble(Rational(p, q), 53), 8924791877541921.0);
}

TEST(Lattice, RefusesWhatItCannotDoExactly) {
    EXPECT_THROW(LatticeOracle({Box{}, {.position = {5, 0}, .mass = 2}}), std::invalid_argument);
    EXPECT_THROW(LatticeOracle({Box{}, {.position = {0.5, 0}}}), std::invalid_argument)
        << "overlap";
    EXPECT_THROW(LatticeOracle({{.position = {1e9, 0}}, {.position = {1e-9, 0}}}),
                 std::invalid_argument)
        << "no common unit";
    LatticeOracle oracle({{.velocity = {1, 0}}});
    EXPECT_THROW(oracle.runUntil(1e-300), std::overflow_error);
}

TEST(Lattice, DoesNotDependOnSlices) {
    const auto boxes = boxesOf(small64);
    LatticeOracle whole(boxes);
    LatticeOracle sliced(boxes);
    whole.runUntil(2);
    for (int k = 1; k <= 64; ++k) sliced.runUntil(k / 32.0);
    ASSERT_EQ(whole.events().size(), sliced.events().size());
    const auto a = whole.state();
    const auto b = sliced.state();
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].position, b[i].position);
}

/// Boxes at integer places with integer speeds: ties and corner hits all over.
std::vector<Box> integerCrowd(int count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto integer = [&](int low, int high) {
        return low + int(random() % std::uint64_t(high - low + 1));
    };
    std::vector<Box> boxes = walls({40, 40});
    std::set<std::pair<int, int>> taken;
    while (int(taken.size()) < count) {
        const int x = integer(-6, 6);
        const int y = integer(-6, 6);
        if (!taken.emplace(x, y).second) continue;
        boxes.push_back({.position = {3.0 * x, 3.0 * y},
                         .velocity = {double(integer(-3, 3)), double(integer(-3, 3))},
                         .size = {2, 2}});
    }
    return boxes;
}

TEST(Lattice, IntegerCrowdHasCornerHitsAndTheSameTiesInDoubles) {
    const auto boxes = integerCrowd(60, 11);
    LatticeOracle there(boxes);
    there.runUntil(64);
    std::size_t corners = 0;
    for (const Event& event : there.events()) corners += event.axis == 3 ? 1 : 0;
    EXPECT_GT(corners, 0u);
    EXPECT_LE(largestOverlap(there.state()), 0);

    Oracle doubles(boxes);
    doubles.runUntil(64);
    ASSERT_EQ(doubles.events().size(), there.events().size());
    for (std::size_t k = 0; k < there.events().size(); ++k) {
        const Event& a = there.events()[k];
        const Event& b = doubles.events()[k];
        ASSERT_TRUE(a.time == b.time && a.i == b.i && a.j == b.j && a.axis == b.axis) << k;
    }
}

}  // namespace
}  // namespace quadrille::reference
