// One value of a scene is replaced from outside it, under all rules of scene files.
#include "core/scene_settings.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <quadrille/scene.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

class SceneSettings : public testing::Test {
  protected:
    Scene load(const std::vector<std::string>& settings) const {
        return loadScene(file_, {.set = settings});
    }
    void expectRefused(const std::string& setting, const std::string& start) const {
        SCOPED_TRACE(setting);
        const std::string error = errorOf<SceneError>([&] { load({setting}); });
        EXPECT_EQ(error.substr(0, start.size()), start) << error;
    }

    TemporaryFolder folder_;
    std::filesystem::path file_ = folder_.write("scene.toml",
                                                "format = 1\n"
                                                "seed = 3\n"
                                                "[world]\n"
                                                "size = [100, 50]\n"
                                                "[[spawn]]\n"
                                                "pattern = \"lattice\"\n"
                                                "count = 5\n"
                                                "size = [1, 1]\n"
                                                "jitter = 0.25\n"
                                                "[[spawn]]\n"
                                                "pattern = \"uniform\"\n"
                                                "count = 7\n"
                                                "size = [1, 1]\n"
                                                "[[body]]\n"
                                                "position = [0, 0]\n"
                                                "size = [1, 1]\n");
};

TEST_F(SceneSettings, ReplaceValues) {
    EXPECT_EQ(load({}).world.movingCount(), 13u);
    EXPECT_EQ(load({"spawn.0.count=20"}).world.movingCount(), 28u);
    EXPECT_EQ(load({"spawn.1.count=0", "body.0.static=true"}).world.movingCount(), 5u);
    EXPECT_EQ(load({"seed=9"}).seed, 9u);
    EXPECT_EQ(load({"world.size=[300, 200]"}).world.config().size, Vec2(300, 200));
    EXPECT_EQ(load({"world.size.0=300"}).world.config().size, Vec2(300, 50));
}

TEST_F(SceneSettings, AddWhatTheFileDoesNotHave) {
    EXPECT_EQ(load({"step.restitution=0.5"}).step.restitution, 0.5);
    EXPECT_EQ(load({"step={ dt = 0.5 }"}).step.dt, 0.5);
    EXPECT_EQ(load({"step.gravity=[0, -10]"}).step.gravity, Vec2(0, -10));
    EXPECT_EQ(load({"world.walls.thickness=2"}).world.staticCount(), 4u);
    EXPECT_EQ(load({"body=[]"}).world.movingCount(), 12u);
}

TEST_F(SceneSettings, LaterOnesGoBeforeEarlierOnes) {
    const Scene scene = load({"step.dt=0.5", "step.restitution=1", "step.dt=0.25"});
    EXPECT_EQ(scene.step.dt, 0.25);
    EXPECT_EQ(scene.step.restitution, 1);
}

TEST_F(SceneSettings, TextNeedsNoQuotes) {
    EXPECT_EQ(load({"step.law=impulse"}).law, Law::Impulse);
    EXPECT_EQ(load({"step.law=\"impulse\""}).law, Law::Impulse);
    EXPECT_EQ(load({"name=a 'b' \"c\" \\d"}).name, "a 'b' \"c\" \\d");
    EXPECT_EQ(load({"name=x=y"}).name, "x=y");
    EXPECT_EQ(load({"spawn.0.color=#ff0000"}).world.movingCount(), 13u);
}

TEST_F(SceneSettings, FailAsTheFileWould) {
    expectRefused("step.restitution=2", "--set: step.restitution: must be from 0 to 1");
    expectRefused("step.restitution=high", "--set: step.restitution: must be a finite number");
    expectRefused("step.restitution=inf", "--set: step.restitution: must be a finite number");
    expectRefused("step.law=newton", "--set: step.law: must be baseline, impulse or continuous");
    expectRefused("spawn.0.count=1.5", "--set: spawn[0].count: must be an integer");
    expectRefused("spawn.0.count=-1", "--set: spawn[0].count: must be from 0 to ");
    expectRefused("spawn.0.size.1=-2", "--set: spawn[0].size: must be positive");
    expectRefused("spawn.0.side=[1, 2]", "--set: spawn[0].side: a group has either size or side");
    expectRefused("world=3", "--set: world: must be a table");
    expectRefused("world.area_per_body=3", "--set: world.area_per_body: a world has either ");
    expectRefused("spawn=[1]", "--set: spawn: must be a list of tables");
    expectRefused("stepp.dt=1", "--set: stepp: is not a known key; known here: ");
    expectRefused("step.dtt=1",
                  "--set: step.dtt: is not a known key; known here: dt, gravity, "
                  "restitution, law; did you mean 'dt'?");
    expectRefused("step.law=continous",
                  "--set: step.law: must be baseline, impulse or "
                  "continuous; did you mean 'continuous'?");
    expectRefused("step.time=1", "--set: step.time: is not a known key; known here: dt, ");
    expectRefused("spawn.0.colour=1", "--set: spawn[0].colour: is not a known key");
    expectRefused("body={ size = [1, 1] }", "--set: body: must be a list of tables");
    expectRefused("body.0={ size = [1, 1] }", "--set: body[0].position: is missing");
    expectRefused("format=2", "--set: format: must be from 1 to 1");
    // What is wrong then is a line of the file.
    expectRefused("spawn.0.pattern=uniform", file_.string() + ":9:10: spawn[0].jitter: ");
}

TEST_F(SceneSettings, NeedAPlaceToGoTo) {
    expectRefused("spawn.2.count=1",
                  "--set: spawn: is a list of 2, counted from 0, and has no '2'");
    expectRefused("spawn.count=1", "--set: spawn: is a list of 2, ");
    expectRefused("spawn.-1.count=1", "--set: spawn: is a list of 2, ");
    expectRefused("spawn.99999999999999999999999.count=1", "--set: spawn: is a list of 2, ");
    expectRefused("instance.0.mass=1", "--set: instance: the scene has none");
    expectRefused("sapwn.0.count=1", "--set: sapwn: the scene has none; did you mean 'spawn'?");
    expectRefused("seed.low=1", "--set: seed: is neither a table nor a list");
    expectRefused("world.size.0.x=1", "--set: world.size.0: is neither a table nor a list");
}

TEST_F(SceneSettings, AreAKeyAndAValueOfOneLine) {
    for (const char* setting :
         {"", "step", "=1", "step dt=1", "\"step.x\".dt=1", "[step]=1", "#a=1", "a\nb=1"}) {
        expectRefused(setting, std::string("--set: '") + setting + "' is not KEY=VALUE");
    }
    expectRefused("step.dt=", "--set:1:9: must be a value, in 'step.dt='");
    expectRefused("step.dt=1 2", "--set:1:11: nothing but a comment");
    expectRefused("step.dt=[1", "--set:1:9: the array does not end");
    expectRefused("step.dt=1979-05-27", "--set:1:13: nothing but a comment");
    expectRefused("step..dt=1", "--set:1:6: must be a key");
    expectRefused("step.dt=1e", "--set:1:");
    expectRefused("step.dt=1\nformat = 1", "--set: must be one line, in ");
    expectRefused("name=a\001b", "--set:1:8: has a control character");
    expectRefused("name=" + std::string(1 << 17, 'x'), "--set:1:65537: a line has at most");
    expectRefused("a.a.a.a.a.a.a.a.a=1", "--set:1:1: a key has at most 8 parts");
}

}  // namespace
}  // namespace quadrille
