#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <quadrille/world.hpp>

#include "core/body_store.hpp"

namespace quadrille {

/// What of a World its interface hides, for those who keep, save and check it.
class WorldAccess {
  public:
    static BodyStore& store(World& world) { return world.store(); }
    static const BodyStore& store(const World& world) { return world.store(); }

    /// The tables of entities.
    template <class Self>
    struct Tables {
        template <class T>
        using As = std::conditional_t<std::is_const_v<Self>, const T, T>;

        As<WorldConfig>& config;
        As<Random>& random;
        As<std::vector<std::uint32_t>>& generations;
        As<std::vector<bool>>& dead;
        As<std::vector<BodyRef>>& slots;
        As<std::vector<std::uint32_t>>& free;
        As<std::vector<Entity>>& condemned;
        As<std::size_t>& alive;
    };
    template <class Self>
    static Tables<Self> tables(Self& world) {
        return {world.config_, world.random_, world.generations_, world.dead_,
                world.slots_,  world.free_,   world.condemned_,   world.alive_};
    }

    template <class C>
    static Pool<C>& pool(World& world) {
        return world.pool<C>();
    }
    template <class C>
    static const Pool<C>* findPool(const World& world) {
        return world.findPool<C>();
    }

    /// Calls `function(PoolBase)` for each pool.
    template <class Function>
    static void forEachPool(const World& world, Function&& function) {
        for (const auto& [key, pool] : world.pools_) function(std::as_const(*pool));
    }

    /// Puts the rows of the bodies in another order: row i becomes what row order[i] was. Nothing
    /// else changes, and no result does.
    static void permute(World& world, std::span<const std::uint32_t> moving,
                        std::span<const std::uint32_t> fixed);
};

}  // namespace quadrille
