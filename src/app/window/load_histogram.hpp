#pragma once

#include <cstddef>
#include <vector>

#include <quadrille/cells.hpp>

namespace quadrille::app {

/// How many cells hold how many bodies.
struct LoadHistogram {
    static constexpr std::size_t mostBins = 32;

    std::size_t binWidth = 1;        ///< bin k: cells with [k, k + 1) * binWidth bodies
    std::vector<std::size_t> cells;  ///< one count a bin
    std::size_t most = 0;            ///< the largest of them
};

LoadHistogram loadHistogram(const Cells& cells);

}  // namespace quadrille::app
