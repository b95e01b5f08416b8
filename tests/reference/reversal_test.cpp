#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

#include "reference/lattice_oracle.hpp"
#include "reference/oracle.hpp"
#include "support.hpp"

// Invariants of accuracy.md, section 2.
namespace quadrille::reference {
namespace {

double distance(const std::vector<Box>& a, const std::vector<Box>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max(largest, (a[i].position - b[i].position).cwiseAbs().maxCoeff());
    }
    return largest;
}

TEST(Reversal, ReturnsToTheStartToTheLastBit) {
    for (const Golden& golden : {small64, a1700, dense1600}) {
        const double time = golden.name == "A1700" ? 64 : 1;
        const auto start = boxesOf(golden);
        LatticeOracle there(start);
        there.runUntil(time);
        LatticeOracle back(reversed(there.state()));
        back.runUntil(time);
        const auto end = reversed(back.state());
        for (std::size_t i = 0; i < start.size(); ++i) {
            ASSERT_EQ(end[i].position, start[i].position) << golden.name << ", box " << i;
            if (!start[i].isStatic) {
                ASSERT_EQ(end[i].velocity, start[i].velocity) << golden.name;
            }
        }
        EXPECT_EQ(back.events().size(), there.events().size());
    }
}

TEST(Reversal, ReturnsFromCornerHits) {
    for (const Vec2& velocity : {Vec2(1, 1), Vec2(3, 3), Vec2(2, 2)}) {
        const std::vector<Box> start{{.position = {0, 0}, .velocity = velocity},
                                     {.position = {5, -5}, .velocity = {-1, 2}},
                                     {.position = {8, 8}, .velocity = {-1, -1}}};
        LatticeOracle there(start);
        there.runUntil(16);
        ASSERT_EQ(there.events().front().axis, 3);
        LatticeOracle back(reversed(there.state()));
        back.runUntil(16);
        EXPECT_EQ(distance(back.state(), start), 0);
    }
}

TEST(Reversal, OfABoxThatMeetsTwoAtOnceIsAMatterOfIds) {
    // 2 lies level on 0 while 1 comes up from below; backwards, 2 lands on both at once.
    const std::vector<Box> start{{.position = {-0.5, 0}, .size = {1, 1}},
                                 {.position = {0.5, -2}, .velocity = {0, 1}, .size = {1, 1}},
                                 {.position = {0, 1}, .size = {1, 1}}};
    LatticeOracle there(start);
    there.runUntil(4);
    ASSERT_EQ(there.events().size(), 1u);
    EXPECT_EQ(there.state()[2].velocity, Vec2(0, 1));
    LatticeOracle back(reversed(there.state()));
    back.runUntil(4);
    ASSERT_EQ(back.events().size(), 1u);
    EXPECT_EQ(back.events()[0].i, 0) << "the lesser id takes the velocity, not 1";
    EXPECT_EQ(back.state()[0].velocity, Vec2(0, -1));
}

TEST(Reversal, ReturnsToTheStartWithUnequalMassesAndSizes) {
    const auto start = mixture(60, 2);
    Oracle there(start);
    there.runUntil(4);
    Oracle back(reversed(there.state()));
    back.runUntil(4);
    EXPECT_LE(distance(back.state(), start), 1e-8);
    EXPECT_EQ(back.events().size(), there.events().size());
}

TEST(Reversal, ReturnsToTheStartUnderGravity) {
    const auto start = mixture(40, 4);
    Oracle there(start, {0, -20});
    there.runUntil(2);
    Oracle back(reversed(there.state()), {0, -20});
    back.runUntil(2);
    EXPECT_LE(distance(back.state(), start), 1e-8);
    EXPECT_EQ(back.events().size(), there.events().size());
}

TEST(Invariant, SortedSpeedsOfEqualMassesKeepTheirBits) {
    auto start = boxesOf(small64);
    // Integers are too easy: the impulse form would keep their bits as well.
    for (std::size_t i = 0; i < start.size(); ++i) start[i].velocity *= 1 + 0.1 / double(i + 1);
    Oracle oracle(start);
    oracle.runUntil(200);
    for (int k = 0; k < 2; ++k) {
        std::vector<double> before;
        std::vector<double> after;
        for (const Box& box : movingOf(start)) before.push_back(std::abs(box.velocity[k]));
        for (const Box& box : movingOf(oracle.state())) after.push_back(std::abs(box.velocity[k]));
        std::sort(before.begin(), before.end());
        std::sort(after.begin(), after.end());
        EXPECT_EQ(before, after);
    }
}

TEST(Invariant, EnergyPerAxisOfUnequalMassesIsKept) {
    const auto start = mixture(100, 6);
    Oracle oracle(start);
    oracle.runUntil(20);
    for (int k = 0; k < 2; ++k) {
        double before = 0;
        double after = 0;
        for (const Box& b : movingOf(start)) before += b.mass * b.velocity[k] * b.velocity[k];
        for (const Box& b : movingOf(oracle.state()))
            after += b.mass * b.velocity[k] * b.velocity[k];
        EXPECT_NEAR(after / before, 1, 1e-12);
    }
}

}  // namespace
}  // namespace quadrille::reference
