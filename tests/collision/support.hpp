#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <quadrille/scene.hpp>
#include <quadrille/simulation.hpp>
#include <quadrille/world.hpp>

namespace quadrille {

template <class Real>
inline constexpr Precision precisionOf = sizeof(Real) == sizeof(double) ? Precision::Double
                                                                        : Precision::Float;

inline Entity makeBox(World& world, const Vec2& position, const PhysicsBody& body = {},
                      const Vec2& size = {2, 2}) {
    const Entity entity = world.create();
    world.add(entity, Transform{position}, BoxCollider{size}, body);
    return entity;
}

inline PhysicsBody moving(double vx, double vy = 0, double mass = 1) {
    return {.velocity = {vx, vy}, .mass = mass};
}
inline PhysicsBody fixed() { return {.isStatic = true}; }

inline Vec2 positionOf(const Simulation& sim, Entity entity) {
    return sim.world().get<Transform>(entity).position;
}
inline Vec2 velocityOf(const Simulation& sim, Entity entity) {
    return sim.world().get<PhysicsBody>(entity).velocity;
}

inline Scene shippedScene(const std::string& name, std::optional<std::uint64_t> entities = {}) {
    return loadScene(QUADRILLE_SCENES_DIR "/" + name + ".toml", {.entities = entities});
}

/// A simulation of a scene with the law `impulse` and the scene's own step settings.
inline Simulation simulationOf(Scene scene, const PartitionerConfig& partitioner,
                               Precision precision = Precision::Double) {
    return Simulation(std::move(scene.world), {.partitioner = partitioner,
                                               .law = Law::Impulse,
                                               .precision = precision,
                                               .step = scene.step});
}

}  // namespace quadrille
