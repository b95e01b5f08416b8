#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

#include <quadrille/scene.hpp>
#include <quadrille/state_hash.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

const std::string open = "format = 1\n[world]\nsize = [100, 50]\n";

SceneOptions entities(std::uint64_t count) {
    SceneOptions options;
    options.entities = count;
    return options;
}
SceneOptions seed(std::uint64_t seed) {
    SceneOptions options;
    options.seed = seed;
    return options;
}
SceneOptions renderers(bool wanted) {
    SceneOptions options;
    options.renderers = wanted;
    return options;
}

class SceneFile : public testing::Test {
  protected:
    Scene load(const std::string& text, const SceneOptions& options = {}) const {
        return loadScene(folder_.write("scene.toml", text), options);
    }

    TemporaryFolder folder_;
};

std::vector<Vec2> movingPositions(const World& world) {
    std::vector<Vec2> result;
    const auto m = world.bodies<double>().moving;
    for (std::size_t i = 0; i < m.size(); ++i) result.emplace_back(m.x[i], m.y[i]);
    return result;
}

// ---- keys

TEST_F(SceneFile, SmallestSceneIsAnOpenEmptyWorldWithDefaults) {
    const Scene scene = load(open);
    EXPECT_EQ(scene.name, "scene") << "the name of the file";
    EXPECT_EQ(scene.seed, 1u);
    EXPECT_EQ(scene.world.config().size, Vec2(100, 50));
    EXPECT_EQ(scene.world.entityCount(), 0u);
    EXPECT_EQ(scene.step.dt, 1.0 / 60);
    EXPECT_EQ(scene.step.gravity, Vec2(0, 0));
    EXPECT_EQ(scene.step.restitution, 1);
    EXPECT_EQ(scene.law, std::nullopt);
}

TEST_F(SceneFile, RootWorldAndStepAreRead) {
    const Scene scene = load(R"(
format = 1
name = "a name"
seed = 77
[world]
size = [640, 480.5]
walls = { thickness = 30, inset = 5 }
[step]
dt = 0.001
gravity = [1, -2.5]
restitution = 0.25
law = "continuous"
)");
    EXPECT_EQ(scene.name, "a name");
    EXPECT_EQ(scene.seed, 77u);
    EXPECT_EQ(scene.world.config().seed, 77u);
    EXPECT_EQ(scene.world.config().size, Vec2(640, 480.5));
    EXPECT_EQ(scene.step.dt, 0.001);
    EXPECT_EQ(scene.step.gravity, Vec2(1, -2.5));
    EXPECT_EQ(scene.step.restitution, 0.25);
    EXPECT_EQ(scene.law, Law::Continuous);
    ASSERT_EQ(scene.world.staticCount(), 4u);
    const Entity left = scene.world.at(0);
    EXPECT_EQ(scene.world.get<Transform>(left).position, Vec2(-320 + 5 - 15, 0));
    EXPECT_EQ(scene.world.get<BoxCollider>(left).size.x(), 30);
}

TEST_F(SceneFile, BodiesAreReadWithAllTheirKeys) {
    const Scene scene = load(open + R"(
[[body]]
name = "ball"
position = [1, -2]
size = [3, 4]
mass = 5
velocity = [6, -7]
color = "#01020304"
[[body]]
position = [10, 20]
size = [30, 40]
static = true
color = "#0a0B0c"
[[body]]
position = [0, 0]
size = [1, 1]
static = false
)",
                             renderers(true));
    const World& world = scene.world;
    const Entity ball = world.find("ball");
    ASSERT_TRUE(world.isBody(ball));
    EXPECT_EQ(world.get<Transform>(ball).position, Vec2(1, -2));
    EXPECT_EQ(world.get<BoxCollider>(ball).size, Vec2(3, 4));
    EXPECT_EQ(world.get<PhysicsBody>(ball).mass, 5);
    EXPECT_EQ(world.get<PhysicsBody>(ball).velocity, Vec2(6, -7));
    EXPECT_EQ(world.get<RectangleRenderer>(ball).color, (Color{1, 2, 3, 4}));
    const Entity block = world.at(1);
    EXPECT_TRUE(world.get<PhysicsBody>(block).isStatic);
    EXPECT_EQ(world.get<BoxCollider>(block).size, Vec2(30, 40));
    EXPECT_EQ(world.get<RectangleRenderer>(block).color, (Color{10, 11, 12, 255}));
    const Entity plain = world.at(2);
    EXPECT_EQ(world.name(plain), "");
    EXPECT_EQ(world.get<PhysicsBody>(plain).mass, 1);
    EXPECT_EQ(world.get<PhysicsBody>(plain).velocity, Vec2(0, 0));
}

TEST_F(SceneFile, RenderersAreMadeOnlyOnRequest) {
    const std::string text =
        "format = 1\n[world]\nsize = [100, 50]\nwalls = {}\n[[spawn]]\n"
        "pattern = \"lattice\"\ncount = 1\nsize = [1, 1]\n";
    for (const bool wanted : {false, true}) {
        const Scene scene = load(text, renderers(wanted));
        ASSERT_EQ(scene.world.entityCount(), 5u);
        for (std::uint32_t i = 0; i < 5; ++i) {
            EXPECT_EQ(scene.world.has<RectangleRenderer>(scene.world.at(i)), wanted) << i;
        }
    }
}

TEST_F(SceneFile, LatticeFillsItsRegionRowByRow) {
    const Scene scene = load(open + R"(
[[spawn]]
pattern = "lattice"
count = 6
region = [[0, 0], [30, 20]]
size = [3, 2]
mass = 4
)");
    const std::vector<Vec2> expected{{5, 5}, {15, 5}, {25, 5}, {5, 15}, {15, 15}, {25, 15}};
    EXPECT_EQ(movingPositions(scene.world), expected);
    EXPECT_EQ(scene.world.get<BoxCollider>(scene.world.at(5)).size, Vec2(3, 2));
    EXPECT_EQ(scene.world.get<PhysicsBody>(scene.world.at(5)).mass, 4);
    EXPECT_EQ(scene.world.get<PhysicsBody>(scene.world.at(5)).velocity, Vec2(0, 0));
}

TEST_F(SceneFile, GroupWithoutARegionFillsTheRoomBetweenTheWalls) {
    const Scene scene = load(R"(
format = 1
[world]
size = [100, 50]
walls = { inset = 10 }
[[spawn]]
pattern = "lattice"
count = 3
size = [1, 1]
)");
    const auto places = movingPositions(scene.world);
    ASSERT_EQ(places.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(places[i].x(), (double(i) - 1) * 80 / 3, 1e-9);
        EXPECT_NEAR(places[i].y(), 0, 1e-9);
    }
}

TEST_F(SceneFile, JitterMovesEveryPlaceOfALatticeALittle) {
    const std::string group = R"(
[[spawn]]
pattern = "lattice"
count = 50
size = [1, 1]
)";
    const auto places = movingPositions(load(open + group).world);
    const auto moved = movingPositions(load(open + group + "jitter = 0.25\n").world);
    ASSERT_EQ(moved.size(), places.size());
    double most = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double distance = (moved[i] - places[i]).cwiseAbs().maxCoeff();
        EXPECT_GT(distance, 0);
        EXPECT_LE(distance, 0.25);
        most = std::max(most, distance);
    }
    EXPECT_GT(most, 0.2);
}

// Positions and velocities follow from the outputs of the standard's generator with seed 7: x, y,
// then sign and integer of each component.
TEST_F(SceneFile, BodiesOfASeedAreTheSameOnEveryPlatform) {
    const Scene scene = load("seed = 7\n" + open + R"(
[[spawn]]
pattern = "uniform"
count = 2
region = [[-10, 0], [30, 20]]
size = [3, 3]
speed = [20, 50]
)");
    const World& world = scene.world;
    EXPECT_EQ(movingPositions(world), (std::vector<Vec2>{{20.17541216611432, 18.986024057852884},
                                                         {23.30091922125783, 18.014209529194165}}));
    EXPECT_EQ(world.get<PhysicsBody>(world.at(0)).velocity, Vec2(44, 46));
    EXPECT_EQ(world.get<PhysicsBody>(world.at(1)).velocity, Vec2(39, -31));
}

TEST_F(SceneFile, SpeedsAreWholeNumbersOfTheRangeWithBothSigns) {
    const Scene scene = load(open + R"(
[[spawn]]
pattern = "uniform"
count = 500
size = [1, 1]
speed = [3, 5]
)");
    std::set<double> speeds;
    for (std::uint32_t i = 0; i < 500; ++i) {
        const Vec2 v = scene.world.get<PhysicsBody>(scene.world.at(i)).velocity;
        speeds.insert({v.x(), v.y()});
    }
    EXPECT_EQ(speeds, (std::set<double>{-5, -4, -3, 3, 4, 5}));
}

TEST_F(SceneFile, SideAndDensityMakeSquaresOfOneMaterial) {
    const Scene scene = load(open + R"(
[[spawn]]
pattern = "uniform"
count = 2000
side = [2, 32]
density = 0.5
)");
    int small = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const Entity entity = scene.world.at(i);
        const Vec2 size = scene.world.get<BoxCollider>(entity).size;
        EXPECT_EQ(size.x(), size.y());
        EXPECT_GE(size.x(), 2);
        EXPECT_LE(size.x(), 32);
        EXPECT_NEAR(scene.world.get<PhysicsBody>(entity).mass, 0.5 * size.x() * size.x(), 1e-9);
        small += size.x() < 4;
    }
    // With density ~ 1 / side^2 the share below 4 is (1/2 - 1/4) / (1/2 - 1/32) = 8/15.
    EXPECT_NEAR(small / 2000.0, 8.0 / 15, 0.06);
}

TEST_F(SceneFile, InstancesComeFromACsvFileBesideTheScene) {
    folder_.write("four.csv", "x,y,vx,vy\n1,2,3,4\n-1.5,2e1,0,-0.25\n");
    folder_.write("six.csv", "x,y,vx,vy,w,h\r\n1,2,3,4,5,6\r\n\r\n");
    folder_.write("seven.csv", "x,y,vx,vy,w,h,mass\n1,2,3,4,5,6,7");
    const Scene scene = load(open + R"(
[[instance]]
file = "four.csv"
size = [3, 2]
mass = 9
color = "#112233"
[[instance]]
file = "six.csv"
mass = 8
[[instance]]
file = "seven.csv"
)",
                             renderers(true));
    const World& world = scene.world;
    ASSERT_EQ(world.movingCount(), 4u);
    EXPECT_EQ(world.get<Transform>(world.at(1)).position, Vec2(-1.5, 20));
    EXPECT_EQ(world.get<PhysicsBody>(world.at(1)).velocity, Vec2(0, -0.25));
    EXPECT_EQ(world.get<BoxCollider>(world.at(1)).size, Vec2(3, 2));
    EXPECT_EQ(world.get<PhysicsBody>(world.at(1)).mass, 9);
    EXPECT_EQ(world.get<RectangleRenderer>(world.at(1)).color, (Color{0x11, 0x22, 0x33}));
    EXPECT_EQ(world.get<BoxCollider>(world.at(2)).size, Vec2(5, 6));
    EXPECT_EQ(world.get<PhysicsBody>(world.at(2)).mass, 8);
    EXPECT_EQ(world.get<PhysicsBody>(world.at(3)).mass, 7);
}

TEST_F(SceneFile, EntitiesAreMadeAsWallsGroupsBodiesInstances) {
    folder_.write("one.csv", "x,y,vx,vy\n4,0,0,0\n");
    const Scene scene = load(R"(
format = 1
[[instance]]
file = "one.csv"
[[body]]
position = [3, 0]
size = [1, 1]
[[spawn]]
pattern = "lattice"
count = 1
region = [[0, -1], [2, 1]]
size = [1, 1]
[[spawn]]
pattern = "lattice"
count = 1
region = [[1, -1], [3, 1]]
size = [1, 1]
[world]
size = [100, 50]
walls = {}
)");
    EXPECT_EQ(scene.world.staticCount(), 4u);
    for (std::uint32_t i = 0; i < 4; ++i) {
        EXPECT_TRUE(scene.world.get<PhysicsBody>(scene.world.at(i)).isStatic);
        EXPECT_EQ(scene.world.get<Transform>(scene.world.at(4 + i)).position, Vec2(i + 1, 0));
    }
}

// ---- seeds and counts

const std::string crowd = open + R"(
[[spawn]]
pattern = "uniform"
count = 100
size = [1, 1]
speed = [1, 9]
[[spawn]]
pattern = "lattice"
count = 10
size = [1, 1]
)";

TEST_F(SceneFile, SameSeedGivesIdenticalBodiesAndAnotherOneOthers) {
    const auto hash = [&](const SceneOptions& options) {
        return stateHash(load(crowd, options).world);
    };
    EXPECT_EQ(hash({}), hash({}));
    EXPECT_EQ(hash({}), hash(seed(1)));
    EXPECT_NE(hash({}), hash(seed(2)));
    EXPECT_EQ(hash(seed(2)), stateHash(load("seed = 2\n" + crowd).world));
    SceneOptions drawn = seed(2);
    drawn.renderers = true;
    EXPECT_EQ(hash(drawn), hash(seed(2)));
    EXPECT_EQ(load(crowd, seed(5)).seed, 5u);
}

TEST_F(SceneFile, EntitiesReplaceTheCountOfTheFirstGroup) {
    EXPECT_EQ(load(crowd).world.movingCount(), 110u);
    EXPECT_EQ(load(crowd, entities(7)).world.movingCount(), 17u);
    EXPECT_EQ(load(crowd, entities(0)).world.movingCount(), 10u);
    EXPECT_NE(errorOf<SceneError>([&] { load(open, entities(7)); }).find("spawn"),
              std::string::npos);
    EXPECT_THROW(load(crowd, entities(50'000'001)), SceneError);
}

TEST_F(SceneFile, WorldGrowsWithItsBodies) {
    const std::string text = R"(
format = 1
[world]
area_per_body = 50
aspect = 2
[[spawn]]
pattern = "lattice"
count = 99
size = [1, 1]
[[body]]
position = [0, 0]
size = [1, 1]
[[body]]
position = [9, 9]
size = [1, 1]
static = true
)";
    const Vec2 size = load(text).world.config().size;
    EXPECT_NEAR(size.x(), 100, 1e-9);
    EXPECT_NEAR(size.y(), 50, 1e-9);
    const Vec2 larger = load(text, entities(399)).world.config().size;
    EXPECT_NEAR(larger.x(), 200, 1e-9);
    EXPECT_NEAR(larger.y(), 100, 1e-9);
}

}  // namespace
}  // namespace quadrille
