#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "app/run_statistics.hpp"

namespace quadrille::app {

/// What each of the last pictures cost, by phase in ms: the phases of its steps, then those of
/// showing it.
class PhaseHistory {
  public:
    static constexpr std::size_t rows = phaseCount + showPhaseCount;
    static constexpr std::size_t length = 160;
    using Row = std::array<float, rows>;

    void add(const Row& row) {
        if (rows_.size() < length) {
            rows_.push_back(row);
        } else {
            rows_[next_] = row;
            next_ = (next_ + 1) % length;
        }
    }
    std::size_t size() const { return rows_.size(); }
    /// From the oldest.
    const Row& operator[](std::size_t i) const { return rows_[(next_ + i) % rows_.size()]; }

    Row mean() const {
        Row sum{};
        for (const Row& row : rows_) {
            for (std::size_t k = 0; k < rows; ++k) sum[k] += row[k];
        }
        for (float& value : sum) value /= float(rows_.empty() ? 1 : rows_.size());
        return sum;
    }

  private:
    std::vector<Row> rows_;
    std::size_t next_ = 0;
};

}  // namespace quadrille::app
