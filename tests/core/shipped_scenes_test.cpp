#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>

#include <quadrille/measure.hpp>
#include <quadrille/scene.hpp>

namespace quadrille {
namespace {

struct Shipped {
    const char* name;
    std::size_t moving, fixed;
};

class ShippedScene : public testing::TestWithParam<Shipped> {};

TEST_P(ShippedScene, HasThePromisedBodies) {
    const auto file =
        std::filesystem::path(QUADRILLE_SCENES_DIR) / (std::string(GetParam().name) + ".toml");
    const Scene scene = loadScene(file);
    EXPECT_EQ(scene.name, GetParam().name);
    EXPECT_EQ(scene.world.movingCount(), GetParam().moving);
    EXPECT_EQ(scene.world.staticCount(), GetParam().fixed);
    EXPECT_EQ(escaped(scene.world), 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, ShippedScene,
    testing::Values(Shipped{"balanced", 50000, 4}, Shipped{"balanced-scaled", 50000, 4},
                    Shipped{"bullet", 1, 1}, Shipped{"cradle", 8, 0}, Shipped{"demo13k", 13400, 4},
                    Shipped{"echo", 657, 4}, Shipped{"gap", 2303, 6},
                    Shipped{"imbalanced", 1700, 8}, Shipped{"imbalanced-clear", 1700, 8},
                    Shipped{"mixed-sizes", 3000, 4}, Shipped{"pi", 2, 1}, Shipped{"pile", 1000, 4}),
    [](const auto& instance) {
        std::string name = instance.param.name;
        std::replace(name.begin(), name.end(), '-', '_');
        return name;
    });

TEST(ShippedScenes, AllLoad) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(QUADRILLE_SCENES_DIR)) {
        if (entry.path().extension() != ".toml") continue;
        EXPECT_NO_THROW(loadScene(entry.path())) << entry.path();
        ++count;
    }
    EXPECT_GE(count, 9u);
}

TEST(ShippedScenes, ImbalancedClearStartsWithoutOverlaps) {
    const Scene scene =
        loadScene(std::filesystem::path(QUADRILLE_SCENES_DIR) / "imbalanced-clear.toml");
    EXPECT_EQ(overlap(scene.world).pairs, 0u);
}

}  // namespace
}  // namespace quadrille
