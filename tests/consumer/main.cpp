#include <quadrille/quadrille.hpp>
int main() {
    quadrille::World world({.size = {640, 480}, .seed = 42});
    world.addWalls({.thickness = 20});
    auto ball = world.create("ball");
    world.add(ball, quadrille::Transform{{0, 0}}, quadrille::BoxCollider{{3, 3}},
                    quadrille::PhysicsBody{.velocity = {60, 20}});
    quadrille::Simulation sim(std::move(world),
                              {.partitioner = quadrille::Quadtree{}, .step = {.dt = 1.0 / 60}});
    sim.onContact([](const quadrille::Contact& c) { /* ... */ });
    sim.run(1000);
}
