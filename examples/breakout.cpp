// Breakout that plays itself: contacts destroy entities, and the paddle is moved by a system.

#include <cstdio>

#include <quadrille/quadrille.hpp>

using namespace quadrille;

struct Brick {
    int points;
};

constexpr double speed = 300;  // px/s

int main() {
    World world({.size = {400, 300}, .seed = 7});
    world.addWalls();
    for (int row = 0; row < 5; ++row) {
        for (int column = 0; column < 9; ++column) {
            world.add(world.create(), Transform{{-160.0 + 40 * column, 40.0 + 20 * row}},
                      BoxCollider{{36, 16}}, PhysicsBody{.isStatic = true}, Brick{10 + 10 * row});
        }
    }
    const Entity paddle = world.create("paddle");
    world.add(paddle, Transform{{0, -140}}, BoxCollider{{60, 8}}, PhysicsBody{.isStatic = true});
    const Entity ball = world.create("ball");
    world.add(ball, Transform{{0, -100}}, BoxCollider{{8, 8}},
              PhysicsBody{.velocity = {0.6 * speed, 0.8 * speed}});

    Simulation game(std::move(world));

    game.addSystem([=](World& w, double) {
        const double x = w.get<Transform>(ball).position.x();
        w.set(paddle, Transform{{x, -140}});
    });

    int score = 0;
    int left = 45;
    game.onContact([&](const Contact& contact) {
        World& w = game.world();
        if (contact.b == paddle) {  // up again, somewhere else
            const double aim = w.random().uniform(-0.8, 0.8);
            w.set(ball, PhysicsBody{.velocity = Vec2(aim, 1).normalized() * speed});
        } else if (w.has<Brick>(contact.b)) {
            score += w.get<Brick>(contact.b).points;
            --left;
            w.destroy(contact.b);
        }
    });

    while (left > 0 && game.stepsDone() < 60 * 600) game.step();
    std::printf("%d bricks left after %.1f s, %d points\n", left, game.time(), score);
}
