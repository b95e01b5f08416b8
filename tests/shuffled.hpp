#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <quadrille/random.hpp>

namespace quadrille {

using Order = std::vector<std::uint32_t>;

/// The numbers below `rows` in any order.
inline Order shuffled(std::size_t rows, Random& random) {
    Order order(rows);
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = rows; i > 1; --i) {
        std::swap(order[i - 1], order[static_cast<std::size_t>(random.integer(0, i - 1))]);
    }
    return order;
}

}  // namespace quadrille
