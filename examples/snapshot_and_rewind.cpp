// A run goes back to where it was, and another one branches off: the bits are the same.

#include <cstdio>

#include <quadrille/quadrille.hpp>

using namespace quadrille;

/// A hundred boxes that fly about between walls.
World crowd() {
    World world({.size = {300, 300}, .seed = 3});
    world.addWalls();
    for (int i = 0; i < 100; ++i) {
        const int column = i % 10;
        const int row = i / 10;
        const Vec2 place{-135.0 + 30 * column, -135.0 + 30 * row};
        const Vec2 velocity{world.random().uniform(-90, 90), world.random().uniform(-90, 90)};
        world.add(world.create(), Transform{place}, BoxCollider{{12, 12}},
                  PhysicsBody{.velocity = velocity});
    }
    return world;
}

const char* equal(bool same) { return same ? "equal" : "different"; }

int main() {
    Simulation sim(crowd(), {.step = {.gravity = {0, -40}}});
    sim.run(120);

    const Snapshot then = sim.snapshot();
    sim.run(240);
    const std::uint64_t later = stateHash(sim.world());

    sim.restore(then);
    std::printf("rewound to step %d\n", int(sim.stepsDone()));
    sim.run(240);
    std::printf("the same steps again: %s\n", equal(stateHash(sim.world()) == later));

    // The bodies of the other run are found with other cells and by all cores.
    Simulation other(World(), {.partitioner = StaticGrid{}, .resolver = ResolverKind::Threads});
    other.restore(then);
    other.run(240);
    std::printf("in another simulation: %s\n", equal(stateHash(other.world()) == later));

    Simulation branch(then.world.clone(), {.step = {.gravity = {0, 40}}});
    branch.run(240);
    std::printf("with gravity turned round: %s\n", equal(stateHash(branch.world()) == later));
}
