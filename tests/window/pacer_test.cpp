#include "app/window/pacer.hpp"

#include <gtest/gtest.h>

namespace quadrille::app {
namespace {

constexpr double dt = 1.0 / 64;  // exact in binary

int stepsOf(Pacer& pacer, double seconds) {
    pacer.pass(seconds);
    int steps = 0;
    while (pacer.take(steps)) ++steps;
    return steps;
}

TEST(Pacer, MakesAsManyStepsAsTimePasses) {
    for (const double speed : {0.25, 0.5, 1.0, 2.0, 8.0}) {
        Pacer pacer(dt, speed);
        int steps = 0;
        for (int picture = 0; picture < 600; ++picture) steps += stepsOf(pacer, 1.0 / 60);
        EXPECT_NEAR(steps, 10 * speed / dt, 1) << speed;
    }
}

TEST(Pacer, JitterOfThePicturesDoesNotShow) {
    Pacer pacer(dt, 1);
    for (int picture = 0; picture < 500; ++picture) {
        EXPECT_EQ(stepsOf(pacer, dt * (picture % 2 == 0 ? 0.9 : 1.1)), 1) << picture;
    }
}

TEST(Pacer, WithoutASpeedEachPictureHasAStep) {
    Pacer pacer(dt, 0);
    for (const double seconds : {0.0, 1e-6, 5.0}) EXPECT_EQ(stepsOf(pacer, seconds), 1);
}

TEST(Pacer, ALongPauseIsNotCaughtUp) {
    Pacer pacer(dt, 1);
    EXPECT_LE(stepsOf(pacer, 3600), int(0.25 / dt) + 1);
    EXPECT_EQ(stepsOf(pacer, -5), 0);
}

TEST(Pacer, DroppedStepsAreGone) {
    Pacer pacer(dt, 8);
    pacer.pass(0.2);
    EXPECT_TRUE(pacer.take(0));
    pacer.drop();
    EXPECT_FALSE(pacer.take(1));
    EXPECT_EQ(stepsOf(pacer, dt / 8), 1);
}

}  // namespace
}  // namespace quadrille::app
