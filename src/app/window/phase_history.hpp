#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <quadrille/config.hpp>

#include "app/run_statistics.hpp"

namespace quadrille::app {

/// What each of the last pictures cost, in ms: the phases of its steps, those of showing it, and
/// what is left of the time until the next.
class PhaseHistory {
  public:
    /// After the phases of steps and of showing.
    enum Rest : std::size_t {
        Present = phaseCount + showPhaseCount - 1,
        Error,        ///< what --error measures
        Unaccounted,  ///< outputs, events, all else
        Wait,         ///< for the time of the next picture
    };
    static constexpr std::size_t rows = Wait + 1;
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

/// Whether a row is work, and not waiting: for the screen, or for the time of the next picture.
inline bool isWork(std::size_t row) {
    return row != PhaseHistory::Present && row != PhaseHistory::Wait;
}

/// What the panels call a row.
const char* phaseWords(std::size_t row);

/// More about it, a sentence.
const char* phaseMeaning(std::size_t row);

/// Whether a row can be anything but 0 in such a run.
bool canOccur(std::size_t row, ResolverKind resolver, bool measuresError);

}  // namespace quadrille::app
