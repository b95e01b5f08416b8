// Rockets: a component of the program's own, a system that acts on it, and an observer that reads
// it and is removed in mid-run.

#include <cstdio>

#include <quadrille/quadrille.hpp>

using namespace quadrille;

/// Any movable type can be a component.
struct Rocket {
    double thrust;  ///< px/s^2, upward
    double fuel;    ///< s
};

/// Before every step: those with fuel go faster, those without are rockets no more.
void burn(World& world, double dt) {
    world.each<Rocket, PhysicsBody>([&](Entity entity, Rocket& rocket, PhysicsBody body) {
        body.velocity.y() += rocket.thrust * dt;
        world.set(entity, body);
        rocket.fuel -= dt;
        if (rocket.fuel <= 0) world.remove<Rocket>(entity);
    });
}

/// A const World lets everything be read and nothing be written.
void report(const World& world, const StepReport& step) {
    if (step.step % 30 != 0) return;
    std::printf("step %3d:", int(step.step));
    world.each<Rocket, Transform>([&](Entity entity, const Rocket& rocket, Transform at) {
        std::printf("  %s at %.1f with %.2f s of fuel", std::string(world.name(entity)).c_str(),
                    at.position.y(), rocket.fuel);
    });
    std::printf("\n");
}

int main() {
    World world({.size = {200, 2000}});
    world.add(world.create("Ada"), Transform{{-50, 0}}, BoxCollider{{4, 12}}, PhysicsBody{},
              Rocket{.thrust = 90, .fuel = 1.25});
    world.add(world.create("Emmy"), Transform{{50, 0}}, BoxCollider{{4, 12}}, PhysicsBody{},
              Rocket{.thrust = 60, .fuel = 2.25});

    Simulation sim(std::move(world), {.step = {.gravity = {0, -10}}});
    sim.addSystem(burn);
    Subscription reports = sim.onStep(report);
    sim.run(120);
    reports.remove();
    sim.run(120);

    sim.world().each<Transform, PhysicsBody>([&](Entity e, Transform at, PhysicsBody body) {
        std::printf("%s ends at %.1f with a speed of %.1f\n",
                    std::string(sim.world().name(e)).c_str(), at.position.y(), body.velocity.y());
    });
}
