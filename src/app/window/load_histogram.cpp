#include "app/window/load_histogram.hpp"

#include <algorithm>

namespace quadrille::app {

LoadHistogram loadHistogram(const Cells& cells) {
    LoadHistogram result;
    const std::size_t mostBodies = loadOf(cells).maxBodies;
    result.binWidth = mostBodies / LoadHistogram::mostBins + 1;
    result.cells.resize(mostBodies / result.binWidth + 1);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        ++result.cells[cells[c].size() / result.binWidth];
    }
    result.most = *std::max_element(result.cells.begin(), result.cells.end());
    return result;
}

}  // namespace quadrille::app
