#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <quadrille/world.hpp>

namespace quadrille::app {

/// Where the moving bodies were in the steps that were shown, in bounded memory.
class Trails {
  public:
    struct Place {
        float x, y;  ///< px
    };

    /// As many steps are kept as that many places of bodies, and no more than `mostSteps`.
    static constexpr std::size_t mostPlaces = 4'000'000, mostSteps = 4'000;

    void clear() { places_.clear(); }

    /// The bodies stand there after so many steps. Of too many steps, that one goes which is the
    /// farthest from this.
    void record(const World& world, std::uint64_t step);

    /// The places of a body, the `body`-th in order of creation, in the `steps` steps up to `step`,
    /// from the oldest; those before a gap are left out.
    std::vector<Place> of(std::size_t body, std::uint64_t step, std::uint64_t steps) const;

  private:
    std::map<std::uint64_t, std::vector<Place>> places_;  // by step
};

}  // namespace quadrille::app
