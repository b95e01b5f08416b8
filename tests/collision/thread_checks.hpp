#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <quadrille/simulation.hpp>
#include <quadrille/world.hpp>

#include "sanitized.hpp"

namespace quadrille {

inline const std::vector<int> threadCounts = {1, 2, 3, 7, 16};

/// All of them; under a sanitizer one, another for each case.
inline std::vector<int> threadCountsOf(std::size_t number) {
    if (!sanitized) return threadCounts;
    return {threadCounts[number % threadCounts.size()]};
}

/// One of each kind that misses no pair, and some with other parameters.
inline const std::vector<PartitionerConfig> completePartitioners = {
    BruteForce{},
    StaticGrid{},
    StaticGrid{{9, 14}},
    Quadtree{},
    Quadtree{6, 3},
    SemiStaticQuadtree{},
    SemiStaticQuadtree{8, 5, SemiStaticQuadtree::Skin{2}},
};

/// Expects that the resolver `threads` gives step by step what `sequential` gives, bit for bit:
/// state, contacts, cells, counts; with a listener and without. Loops are shared out however short
/// they are. `edit(world, number)` may change the world before a step.
void expectTheSameOnThreads(
    const std::function<World()>& makeWorld, SimulationConfig config, std::uint64_t steps,
    const std::vector<int>& threads,
    const std::function<void(World&, std::uint64_t)>& edit = [](World&, std::uint64_t) {});

}  // namespace quadrille
