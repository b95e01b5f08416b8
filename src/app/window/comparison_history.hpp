#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "app/run_beside.hpp"

namespace quadrille::app {

/// What the plots of a comparison show of a time.
struct ComparisonPoint {
    double time = 0;                     ///< s
    std::array<double, 2> bodies{};      ///< apart, wrong
    std::array<double, 2> collisions{};  ///< missed, invented
    std::array<double, 2> overlap{};     ///< of each run, in sides
    std::array<double, 2> cost{};        ///< of each run, ms, mean of some frames
};

/// A comparison from its start to now, in bounded memory: of a long one, every 2^n-th point.
class ComparisonHistory {
  public:
    static constexpr std::size_t most = 4096;

    void add(const ComparedFrame& frame);
    void clear() { *this = {}; }
    const std::vector<ComparisonPoint>& points() const { return points_; }

  private:
    std::vector<ComparisonPoint> points_;
    std::size_t stride_ = 1, since_ = 0;
    std::array<double, 2> cost_{};
};

}  // namespace quadrille::app
