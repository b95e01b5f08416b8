#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <quadrille/detail/column.hpp>

namespace quadrille {

/// The places of rows in the order of creation, counted from 0, and the rows in that order. Stores
/// nothing while both are the same.
class CreationRanks {
  public:
    CreationRanks(const CreationOrder& created, std::size_t rows) {
        if (created.isRowOrder()) return;
        rows_.resize(rows);
        std::iota(rows_.begin(), rows_.end(), 0u);
        std::sort(rows_.begin(), rows_.end(),
                  [&](std::uint32_t p, std::uint32_t q) { return created[p] < created[q]; });
        ranks_.resize(rows);
        for (std::size_t i = 0; i < rows; ++i) ranks_[rows_[i]] = static_cast<std::uint32_t>(i);
    }

    /// The place of a row.
    std::size_t operator[](std::size_t row) const { return ranks_.empty() ? row : ranks_[row]; }
    /// The row at a place.
    std::size_t rowAt(std::size_t place) const { return rows_.empty() ? place : rows_[place]; }

  private:
    std::vector<std::uint32_t> rows_, ranks_;
};

}  // namespace quadrille
