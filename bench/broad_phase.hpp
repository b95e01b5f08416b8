#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <quadrille/vec2.hpp>

namespace quadrille::bench {

/// The boxes of all bodies at the end of a step, moving ones first. Coordinates are whole multiples
/// of 1/1024 px, so that sums and differences are exact and every algorithm means the same by an
/// overlap.
struct Boxes {
    std::size_t moving = 0;
    std::vector<double> x, y, halfWidth, halfHeight;
    std::vector<double> vx, vy;  ///< of the moving ones, px/s

    std::size_t size() const { return x.size(); }

    /// Whether two of them have a common inner point.
    bool overlap(std::size_t i, std::size_t j) const {
        return std::abs(x[i] - x[j]) < halfWidth[i] + halfWidth[j] &&
               std::abs(y[i] - y[j]) < halfHeight[i] + halfHeight[j];
    }
};

/// Overlapping pairs, at least one of each moving, in any order; each pair once.
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// An algorithm that finds them. What it learns in one frame it may use in the next.
class BroadPhase {
  public:
    virtual ~BroadPhase() = default;

    /// What is not timed: taking over what does not belong to the algorithm.
    virtual void prepare(const Boxes&) {}
    /// Appends the pairs of the frame.
    virtual void find(const Boxes& boxes, Pairs& pairs) = 0;
};

/// What stays over all frames.
struct Setting {
    Vec2 worldSize;
    double dt;
};

struct BroadPhaseKind {
    std::string name;
    std::function<std::unique_ptr<BroadPhase>(const Setting&, const Boxes& first)> make;
};

/// The partitioners with the narrow phase, as a step of `impulse` uses them.
std::vector<BroadPhaseKind> ownBroadPhases();
/// All with all, and sort and sweep along x, anew in each frame and with the order of the frame
/// before.
std::vector<BroadPhaseKind> plainBroadPhases();
BroadPhaseKind cgalBroadPhase();
BroadPhaseKind boostBroadPhase();

}  // namespace quadrille::bench
