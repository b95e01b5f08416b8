// Places in the order of creation, from numbers that have gaps and lie in any order.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <numeric>
#include <utility>
#include <vector>

#include <quadrille/creation_ranks.hpp>
#include <quadrille/random.hpp>

namespace quadrille {
namespace {

TEST(CreationRanks, AreTheRowsWhereThoseLieInOrder) {
    const CreationRanks ranks(CreationOrder{}, 5);
    for (std::size_t row = 0; row < 5; ++row) {
        EXPECT_EQ(ranks[row], row);
        EXPECT_EQ(ranks.rowAt(row), row);
    }
}

TEST(CreationRanks, CountWithoutTheGapsOfDestroyedBodies) {
    const std::vector<std::uint32_t> numbers{40, 7, 1000, 8};
    const CreationRanks ranks(CreationOrder{numbers}, 4);
    EXPECT_EQ(ranks[0], 2u);
    EXPECT_EQ(ranks[1], 0u);
    EXPECT_EQ(ranks[2], 3u);
    EXPECT_EQ(ranks[3], 1u);
    EXPECT_EQ(ranks.rowAt(0), 1u);
    EXPECT_EQ(ranks.rowAt(3), 2u);
}

TEST(CreationRanks, ArePlacesAndRowsBothWays) {
    Random random(3);
    std::vector<std::uint32_t> numbers(500);
    std::iota(numbers.begin(), numbers.end(), 0u);
    for (std::uint32_t& number : numbers) number = 3 * number + 1;
    for (std::size_t i = numbers.size(); i > 1; --i) {
        std::swap(numbers[i - 1], numbers[static_cast<std::size_t>(random.integer(0, i - 1))]);
    }
    const CreationRanks ranks(CreationOrder{numbers}, numbers.size());
    for (std::size_t row = 0; row < numbers.size(); ++row) {
        EXPECT_EQ(ranks[row], numbers[row] / 3);
        EXPECT_EQ(ranks.rowAt(ranks[row]), row);
    }
}

}  // namespace
}  // namespace quadrille
