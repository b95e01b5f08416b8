// The scene `echo`: boxes that flew apart for ten seconds come back to where they began, each after
// some forty collisions, only if every collision is at its time and between the right two.

#include <cmath>
#include <gtest/gtest.h>

#include <quadrille/quadrille.hpp>

#include "collision/support.hpp"

namespace quadrille {
namespace {

/// Bodies that stand where boxes of the word do: on a lattice, but for 0.3 px of jitter.
std::size_t inTheWord(const World& world) {
    constexpr double pitch = 20.0 / 3, jitter = 0.301;
    const auto onLattice = [](double place) {
        const double steps = (place + 290) / pitch - 0.5;
        return std::abs(steps - std::round(steps)) * pitch <= jitter;
    };
    std::size_t count = 0;
    world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        for (std::size_t i = 0; i < m.size(); ++i) {
            const bool near = std::abs(double(m.x[i])) < 290 && std::abs(double(m.y[i])) < 70;
            // The word is 7 dots high, so that its rows of boxes lie half a dot off the middle.
            count += near && onLattice(double(m.x[i])) && onLattice(double(m.y[i]));
        }
    });
    return count;
}

std::size_t afterTenSeconds(Law law, Precision precision = Precision::Double) {
    Scene scene = shippedScene("echo");
    Simulation simulation(std::move(scene.world),
                          {.law = law, .precision = precision, .step = scene.step});
    EXPECT_LT(inTheWord(simulation.world()), 30u);
    simulation.run(600);
    return inTheWord(simulation.world());
}

TEST(Echo, TheExactLawBringsTheWordBack) { EXPECT_EQ(afterTenSeconds(Law::Continuous), 657u); }

TEST(Echo, ADiscreteLawDoesNot) { EXPECT_LT(afterTenSeconds(Law::Impulse), 60u); }

}  // namespace
}  // namespace quadrille
