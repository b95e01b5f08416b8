// The map of the plane to integer cells: monotone, clamped, and made so that two boxes which
// overlap share a cell, whatever rounding does to their edges.

#include "collision/rules/fine_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>

#include <quadrille/random.hpp>

#include "collision/broad/body_ranges.hpp"
#include "reals.hpp"

namespace quadrille {
namespace {

template <class Real>
class FineGridTest : public testing::Test {};

TYPED_TEST_SUITE(FineGridTest, Reals, RealNames);

bool equal(const FineRange& range, const FineRange& expected) {
    return range.x0 == expected.x0 && range.y0 == expected.y0 && range.x1 == expected.x1 &&
           range.y1 == expected.y1;
}

TYPED_TEST(FineGridTest, IsASingleCellByDefault) {
    using Real = TypeParam;
    const FineGrid<Real> grid;
    EXPECT_TRUE(equal(grid.range(Real(-1e9), Real(1e9), 1, 1), {0, 0, 0, 0}));
}

TYPED_TEST(FineGridTest, CellsAreHalfOpen) {
    using Real = TypeParam;
    // 8 x 4 cells of 16 x 8 px from (-64, -16).
    const auto grid = makeFineGrid<Real>({-64, -16}, {16, 8}, 8, 4);
    const auto column = [&](Real x) {
        return FineGrid<Real>::coordinate(x, grid.lowX, grid.perX, grid.lastX);
    };
    const auto row = [&](Real y) {
        return FineGrid<Real>::coordinate(y, grid.lowY, grid.perY, grid.lastY);
    };
    EXPECT_EQ(column(-64), 0);
    EXPECT_EQ(column(std::nextafter(Real(-48), Real(-100))), 0);
    EXPECT_EQ(column(-48), 1);
    EXPECT_EQ(column(0), 4);
    EXPECT_EQ(row(Real(7.99)), 2);
    EXPECT_EQ(row(8), 3);
}

TYPED_TEST(FineGridTest, BorderCellsReachToInfinity) {
    using Real = TypeParam;
    const auto grid = makeFineGrid<Real>({-64, -16}, {16, 8}, 8, 4);
    constexpr Real most = std::numeric_limits<Real>::max();
    constexpr Real infinite = std::numeric_limits<Real>::infinity();
    for (const Real far : {Real(65), Real(1e6), most, infinite}) {
        EXPECT_EQ(FineGrid<Real>::coordinate(far, grid.lowX, grid.perX, grid.lastX), 7);
        EXPECT_EQ(FineGrid<Real>::coordinate(-far, grid.lowX, grid.perX, grid.lastX), 0);
    }
    // Not a place at all; a cell even so, so that nothing is written where it must not be.
    EXPECT_EQ(FineGrid<Real>::coordinate(std::numeric_limits<Real>::quiet_NaN(), grid.lowX,
                                         grid.perX, grid.lastX),
              0);
    EXPECT_TRUE(equal(grid.range(0, 0, Real(1e6), Real(1e6)), {0, 0, 7, 3}));
}

TYPED_TEST(FineGridTest, IsMonotone) {
    using Real = TypeParam;
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const double width = std::pow(10, random.uniform(-3, 4));
        const auto cells = static_cast<std::uint32_t>(random.integer(1, 65'535));
        const auto grid = makeFineGrid<Real>({-width * 10, 0}, {width, 1}, cells, 1);
        const auto column = [&](Real x) {
            return FineGrid<Real>::coordinate(x, grid.lowX, grid.perX, grid.lastX);
        };
        const auto x = static_cast<Real>(random.uniform(-20, 40) * width);
        const auto next = std::nextafter(x, std::numeric_limits<Real>::max());
        ASSERT_LE(column(x), column(next));
        ASSERT_LT(column(next), cells);
    }
}

TYPED_TEST(FineGridTest, ABoxTouchesTheCellsOfAllItsPoints) {
    using Real = TypeParam;
    const auto grid = makeFineGrid<Real>({-64, -16}, {16, 8}, 8, 4);
    EXPECT_TRUE(equal(grid.range(-24, 4, 2, 1), {2, 2, 2, 2}));
    EXPECT_TRUE(equal(grid.range(0, 0, 2, 1), {3, 1, 4, 2}));
    // An edge on a border belongs to both sides: a neighbour may reach over by rounding.
    EXPECT_TRUE(equal(grid.range(8, 4, 8, 4), {3, 1, 5, 3}));
}

TYPED_TEST(FineGridTest, BoxesThatOverlapShareACell) {
    using Real = TypeParam;
    Random random(2);
    int pairs = 0;
    for (int i = 0; i < 200'000; ++i) {
        const double size = std::pow(10, random.uniform(-2, 3));
        const double cell = std::pow(10, random.uniform(-1, 2));
        const auto grid = makeFineGrid<Real>({-1000, -1000}, {cell, cell}, 2000, 2000);
        const auto draw = [&](double low, double high) {
            return static_cast<Real>(random.uniform(low, high));
        };
        const Real x = draw(-1000, 1000);
        const Real half = draw(0, size);
        const Real otherHalf = draw(0, size);
        // Some units of the last place on either side of touching.
        Real other = x + half + otherHalf;
        for (auto n = random.integer(0, 4); n > 0; --n) other = std::nextafter(other, x);
        if (!overlaps(other - x, Real(0), half + otherHalf, Real(1))) continue;
        ++pairs;
        const FineRange p = grid.range(x, 0, half, 1);
        const FineRange q = grid.range(other, 0, otherHalf, 1);
        ASSERT_TRUE(std::max(p.x0, q.x0) <= std::min(p.x1, q.x1))
            << x << ", " << half << "; " << other << ", " << otherHalf << "; cell " << cell;
    }
    EXPECT_GT(pairs, 50'000);
}

TYPED_TEST(FineGridTest, InflationMovesTheEdgesAndNothingElse) {
    using Real = TypeParam;
    const auto grid = makeFineGrid<Real>({0, 0}, {1, 1}, 100, 100);
    EXPECT_TRUE(equal(grid.range(50.5, 60.5, 3, 2), {47, 58, 53, 62}));
    EXPECT_TRUE(equal(grid.range(50.5, 60.5, 3 + 4, 2 + 4), {43, 54, 57, 66}));
}

}  // namespace
}  // namespace quadrille
