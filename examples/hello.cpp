// The program of the README, with something printed: a ball between four walls.

#include <cstdio>

#include <quadrille/quadrille.hpp>

int main() {
    quadrille::World world({.size = {640, 480}, .seed = 42});
    world.addWalls({.thickness = 20});
    const auto ball = world.create("ball");
    world.add(ball, quadrille::Transform{{0, 0}}, quadrille::BoxCollider{{3, 3}},
              quadrille::PhysicsBody{.velocity = {60, 20}});

    quadrille::Simulation sim(std::move(world),
                              {.partitioner = quadrille::Quadtree{}, .step = {.dt = 1.0 / 60}});
    sim.onContact([](const quadrille::Contact& c) {
        std::printf("%6.3f s: the ball hits a wall that lies toward %g, %g\n", c.time, c.normal.x(),
                    c.normal.y());
    });
    sim.run(1000);

    const auto at = sim.world().get<quadrille::Transform>(ball).position;
    std::printf("%6.3f s: the ball is at %.2f, %.2f\n", sim.time(), at.x(), at.y());
}
