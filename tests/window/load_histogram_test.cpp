#include "app/window/load_histogram.hpp"

#include <gtest/gtest.h>
#include <numeric>
#include <vector>

namespace quadrille::app {
namespace {

Cells cellsWith(const std::vector<std::size_t>& counts) {
    Cells cells;
    for (const std::size_t count : counts) {
        cells.bodies.resize(cells.bodies.size() + count);
        cells.offsets.push_back(static_cast<std::uint32_t>(cells.bodies.size()));
    }
    return cells;
}

TEST(LoadHistogram, CountsCellsByTheirBodies) {
    const LoadHistogram h = loadHistogram(cellsWith({0, 3, 1, 3, 3, 0}));
    EXPECT_EQ(h.binWidth, 1u);
    EXPECT_EQ(h.cells, (std::vector<std::size_t>{2, 1, 0, 3}));
    EXPECT_EQ(h.most, 3u);
}

TEST(LoadHistogram, WidensItsBinsForCrowdedCells) {
    for (const std::size_t most : {31u, 32u, 33u, 100u, 12345u}) {
        const LoadHistogram h = loadHistogram(cellsWith({0, 1, most / 2, most}));
        EXPECT_LE(h.cells.size(), LoadHistogram::mostBins);
        EXPECT_EQ(std::accumulate(h.cells.begin(), h.cells.end(), std::size_t(0)), 4u);
        EXPECT_GE(h.cells.back(), 1u);
        EXPECT_GE(h.cells.size() * h.binWidth, most + 1);
    }
}

TEST(LoadHistogram, OfNothingIsEmpty) {
    EXPECT_EQ(loadHistogram(Cells{}).most, 0u);
    EXPECT_EQ(loadHistogram(cellsWith({0, 0})).cells, std::vector<std::size_t>{2});
}

}  // namespace
}  // namespace quadrille::app
