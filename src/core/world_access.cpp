#include "core/world_access.hpp"

#include <variant>

namespace quadrille {

void WorldAccess::permute(World& world, std::span<const std::uint32_t> moving,
                          std::span<const std::uint32_t> fixed) {
    world.store().permute(moving, fixed);
    std::visit(
        [&](const auto& columns) {
            const auto link = [&](const auto& set, auto&& refOf) {
                for (std::uint32_t i = 0; i < set.size(); ++i) {
                    world.slots_[set.entity[i]] = refOf(i);
                }
            };
            link(columns.moving, &BodyRef::moving);
            link(columns.fixed, &BodyRef::fixed);
        },
        world.store().columns());
}

}  // namespace quadrille
