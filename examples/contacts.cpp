// Newton's cradle whose last body is three times as heavy as the others: contacts are pulled after
// each step, each with what its bodies exchanged.

#include <array>
#include <cstdio>

#include <quadrille/quadrille.hpp>

using namespace quadrille;

int main() {
    World world({.size = {400, 100}});
    std::array<Entity, 4> bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        bodies[i] = world.create();
        const bool first = i == 0;
        const bool last = i + 1 == bodies.size();
        world.add(bodies[i], Transform{{first ? -100 : 20.0 * double(i), 0}}, BoxCollider{{20, 20}},
                  PhysicsBody{.velocity = {first ? 60.0 : 0.0, 0}, .mass = last ? 3.0 : 1.0});
    }

    Simulation sim(std::move(world), {.law = Law::Continuous, .keepContacts = true});

    std::printf("time, s  pair  approach  impulse  expected\n");
    while (sim.time() < 4) {
        sim.step();
        for (const Contact& c : sim.contacts()) {
            const double a = sim.world().get<PhysicsBody>(c.a).mass;
            const double b = sim.world().get<PhysicsBody>(c.b).mass;
            const double expected = 2 * a * b / (a + b) * c.approach.x();
            std::printf("%7.4f  %d, %d  %8.3f  %7.3f  %8.3f\n", c.time, int(c.numberA),
                        int(c.numberB), c.approach.x(), c.impulse.x(), expected);
        }
    }
    std::printf("speeds in the end:");
    for (const Entity body : bodies) {
        std::printf(" %.3f", sim.world().get<PhysicsBody>(body).velocity.x());
    }
    std::printf("\n");
}
