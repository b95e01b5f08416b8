#include "app/window/theme.hpp"

#include <gtest/gtest.h>

namespace quadrille::app {
namespace {

TEST(Contrast, IsThatOfWcag) {
    EXPECT_NEAR(contrast({0, 0, 0}, {255, 255, 255}), 21, 1e-9);
    EXPECT_NEAR(contrast({255, 255, 255}, {0, 0, 0}), 21, 1e-9);
    EXPECT_NEAR(contrast({80, 80, 80}, {80, 80, 80}), 1, 1e-12);
    EXPECT_NEAR(contrast({119, 119, 119}, {255, 255, 255}), 4.48, 0.01);
}

TEST(Theme, EveryTextCanBeRead) {
    for (const TextColors& pair : textColors()) {
        EXPECT_GE(contrast(pair.text, pair.ground), 4.5) << pair.where;
    }
}

}  // namespace
}  // namespace quadrille::app
