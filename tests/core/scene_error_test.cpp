#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <quadrille/scene.hpp>

#include "support.hpp"

namespace quadrille {
namespace {

/// The text of a scene file, and how its error goes on after the name of the file.
struct Refused {
    std::string text, where;
};

const std::string open = "format = 1\n[world]\nsize = [100, 50]\n";

/// Scenes that are right up to the lines given.
std::string after(const std::string& lines) { return open + lines; }
std::string walls(const std::string& inside) { return after("walls = { " + inside + " }"); }
std::string step(const std::string& line) { return after("[step]\n" + line); }
std::string group(const std::string& lines) {
    return after("[[spawn]]\npattern = \"uniform\"\ncount = 1\n" + lines);
}
std::string body(const std::string& lines) {
    return after("[[body]]\nposition = [0, 0]\nsize = [1, 1]\n" + lines);
}

bool startsWith(const std::string& text, const std::string& start) {
    return text.compare(0, start.size(), start) == 0;
}

class SceneErrors : public testing::Test {
  protected:
    void expectRefused(const Refused& refused) const {
        SCOPED_TRACE(refused.text);
        const auto file = folder_.write("scene.toml", refused.text);
        const std::string error = errorOf<SceneError>([&] { loadScene(file); });
        EXPECT_TRUE(startsWith(error, file.string() + refused.where))
            << "is        " << error << "\nshould be " << file.string() << refused.where;
    }
    void expectTableRefused(const std::string& csv, const std::string& where) const {
        SCOPED_TRACE(csv);
        const auto table = folder_.write("table.csv", csv);
        const auto scene = folder_.write("scene.toml", after("[[instance]]\nfile = \"table.csv\""));
        const std::string error = errorOf<SceneError>([&] { loadScene(scene); });
        EXPECT_TRUE(startsWith(error, table.string() + where))
            << "is        " << error << "\nshould be " << table << where;
    }
    /// What holds of all of the table is said where the scene asks for it.
    void expectWholeTableRefused(const std::string& table, const std::string& reason) const {
        const auto path = folder_.path() / table;
        expectRefused({after("[[instance]]\nfile = \"" + table + "\""),
                       ":5:8: instance[0].file: " + path.string() + ": " + reason});
    }

    TemporaryFolder folder_;
};

TEST_F(SceneErrors, UnknownKeysAtEveryLevel) {
    for (const Refused& refused : {
             Refused{"speed = 3\n" + open, ":1:9: speed: is not a known key; known here: "},
             Refused{after("colour = 3"), ":4:10: world.colour: is not a known key; known here: "},
             Refused{walls("depth = 1"),
                     ":4:19: world.walls.depth: is not a known key; known here: "},
             Refused{step("time = 1"), ":5:8: step.time: is not a known key; known here: "},
             Refused{group("size = [1, 1]\nvelocity = [0, 0]"),
                     ":8:12: spawn[0].velocity: is not a known key; known here: "},
             Refused{body("speed = [0, 0]"),
                     ":7:9: body[0].speed: is not a known key; known here: "},
             Refused{after("[[instance]]\nfile = \"a.csv\"\nstatic = true"),
                     ":6:10: instance[0].static: is not a known key; known here: "},
             Refused{after("[camera]\nzoom = 1"), ":4:1: camera: is not a known key; known here: "},
         }) {
        expectRefused(refused);
    }
}

TEST_F(SceneErrors, OfMistypedNamesSayWhichOnesAreNear) {
    for (const Refused& refused : {
             Refused{after("[setp]\ndt = 1"),
                     ":4:1: setp: is not a known key; known here: format, "
                     "name, seed, world, step, spawn, body, instance; did "
                     "you mean 'step'?"},
             Refused{step("restituion = 1"),
                     ":5:14: step.restituion: is not a known key; known "
                     "here: dt, gravity, restitution, law; did you mean "
                     "'restitution'?"},
             Refused{step("law = \"impluse\""),
                     ":5:7: step.law: must be baseline, impulse or "
                     "continuous; did you mean 'impulse'?"},
             Refused{after("[[spawn]]\npattern = \"latice\""),
                     ":5:11: spawn[0].pattern: must be \"lattice\" or \"uniform\"; did you mean "
                     "'lattice'?"},
             // A key that must be there is missed before another one is found to be unknown.
             Refused{"format = 1\n[wrold]\nsize = [1, 1]\n",
                     ":1:1: world: is missing; 'wrold' is not a known key; did you mean 'world'?"},
             Refused{after("[[body]]\nsize = [1, 1]\npositon = [0, 0]"),
                     ":4:1: body[0].position: is missing; 'positon' is not a known key; did you "
                     "mean 'position'?"},
         }) {
        expectRefused(refused);
    }
}

TEST_F(SceneErrors, WrongTypes) {
    for (const Refused& refused : {
             Refused{"format = \"1\"\n[world]\nsize = [1, 1]\n", ":1:10: format: "},
             Refused{"format = 1.0\n[world]\nsize = [1, 1]\n", ":1:10: format: "},
             Refused{"name = 3\n" + open, ":1:8: name: "},
             Refused{"seed = 1.5\n" + open, ":1:8: seed: "},
             Refused{"format = 1\nworld = 3", ":2:9: world: "},
             Refused{"format = 1\n[world]\nsize = 5", ":3:8: world.size: "},
             Refused{"format = 1\n[world]\nsize = [1]", ":3:8: world.size: "},
             Refused{"format = 1\n[world]\nsize = [1, \"a\"]", ":3:8: world.size: "},
             Refused{"format = 1\n[world]\narea_per_body = \"a\"", ":3:17: world.area_per_body: "},
             Refused{after("walls = true"), ":4:9: world.walls: "},
             Refused{walls("thickness = \"a\""), ":4:23: world.walls.thickness: "},
             Refused{walls("inset = [1]"), ":4:19: world.walls.inset: "},
             Refused{step("dt = true"), ":5:6: step.dt: "},
             Refused{step("gravity = -10"), ":5:11: step.gravity: "},
             Refused{step("gravity = [0, 0, -10]"), ":5:11: step.gravity: "},
             Refused{step("restitution = [1]"), ":5:15: step.restitution: "},
             Refused{"spawn = 3\n" + open, ":1:9: spawn: "},
             Refused{"body = [1]\n" + open, ":1:8: body: "},
             Refused{after("[instance]\nfile = \"a.csv\""), ":4:1: instance: "},
             Refused{after("[[spawn]]\npattern = 1"), ":5:11: spawn[0].pattern: "},
             Refused{after("[[spawn]]\npattern = \"uniform\"\ncount = 1.5"),
                     ":6:9: spawn[0].count: "},
             Refused{group("region = [1, 2]"), ":7:10: spawn[0].region: "},
             Refused{group("size = 3"), ":7:8: spawn[0].size: "},
             Refused{group("side = 3"), ":7:8: spawn[0].side: "},
             Refused{group("size = [1, 1]\nmass = \"1\""), ":8:8: spawn[0].mass: "},
             Refused{group("size = [1, 1]\nspeed = 3"), ":8:9: spawn[0].speed: "},
             Refused{group("size = [1, 1]\ncolor = 3"), ":8:9: spawn[0].color: "},
             Refused{after("[[body]]\nposition = 1"), ":5:12: body[0].position: "},
             Refused{body("static = 1"), ":7:10: body[0].static: "},
             Refused{body("velocity = \"fast\""), ":7:12: body[0].velocity: "},
             Refused{body("name = 5"), ":7:8: body[0].name: "},
             Refused{after("[[instance]]\nfile = 5"), ":5:8: instance[0].file: "},
         }) {
        expectRefused(refused);
    }
}

TEST_F(SceneErrors, ImpossibleValues) {
    for (const Refused& refused : {
             Refused{"format = 2\n[world]\nsize = [1, 1]\n", ":1:10: format: "},
             Refused{"seed = -1\n" + open, ":1:8: seed: "},
             Refused{"format = 1\n[world]\nsize = [0, 1]", ":3:8: world.size: "},
             Refused{"format = 1\n[world]\nsize = [1, inf]", ":3:8: world.size: "},
             Refused{"format = 1\n[world]\narea_per_body = 0", ":3:17: world.area_per_body: "},
             Refused{"format = 1\n[world]\narea_per_body = 1\naspect = -1",
                     ":4:10: world.aspect: "},
             Refused{walls("thickness = 0"), ":4:23: world.walls.thickness: "},
             Refused{walls("inset = -1"), ":4:19: world.walls.inset: "},
             Refused{walls("inset = 25"), ":4:19: world.walls.inset: "},
             Refused{step("dt = 0"), ":5:6: step.dt: "},
             Refused{step("dt = nan"), ":5:6: step.dt: "},
             Refused{step("gravity = [0, inf]"), ":5:11: step.gravity: "},
             Refused{step("restitution = 1.5"), ":5:15: step.restitution: "},
             Refused{step("restitution = -0.5"), ":5:15: step.restitution: "},
             Refused{step("law = \"magic\""),
                     ":5:7: step.law: must be baseline, impulse or continuous"},
             Refused{step("law = 3"), ":5:7: step.law: "},
             Refused{after("[[spawn]]\npattern = \"hexagonal\""), ":5:11: spawn[0].pattern: "},
             Refused{after("[[spawn]]\npattern = \"uniform\"\ncount = -1"),
                     ":6:9: spawn[0].count: "},
             Refused{after("[[spawn]]\npattern = \"uniform\"\ncount = 50000001"),
                     ":6:9: spawn[0].count: "},
             Refused{group("region = [[1, 0], [0, 1]]"), ":7:10: spawn[0].region: "},
             Refused{group("region = [[0, 0], [1, 0]]"), ":7:10: spawn[0].region: "},
             Refused{group("size = [1, -1]"), ":7:8: spawn[0].size: "},
             Refused{group("side = [0, 1]"), ":7:8: spawn[0].side: "},
             Refused{group("side = [2, 1]"), ":7:8: spawn[0].side: "},
             Refused{group("size = [1, 1]\nmass = 0"), ":8:8: spawn[0].mass: "},
             Refused{group("size = [1, 1]\ndensity = -1"), ":8:11: spawn[0].density: "},
             Refused{group("size = [1, 1]\nspeed = [-1, 2]"), ":8:9: spawn[0].speed: "},
             Refused{group("size = [1, 1]\nspeed = [1, 2.5]"), ":8:9: spawn[0].speed: "},
             Refused{group("size = [1, 1]\nspeed = [3, 2]"), ":8:9: spawn[0].speed: "},
             Refused{
                 after("[[spawn]]\npattern = \"lattice\"\ncount = 1\nsize = [1, 1]\njitter = -1"),
                 ":8:10: spawn[0].jitter: "},
             Refused{body("color = \"red\""), ":7:9: body[0].color: "},
             Refused{body("color = \"#12345\""), ":7:9: body[0].color: "},
             Refused{body("color = \"#12345g\""), ":7:9: body[0].color: "},
             Refused{body("color = \"#-12345\""), ":7:9: body[0].color: "},
             Refused{body("mass = -1"), ":7:8: body[0].mass: "},
             Refused{body("mass = inf"), ":7:8: body[0].mass: "},
             Refused{after("[[body]]\nposition = [nan, 0]"), ":5:12: body[0].position: "},
             Refused{after("[[body]]\nposition = [0, 0]\nsize = [1, 0]"), ":6:8: body[0].size: "},
             Refused{after("[[instance]]\nfile = \"a.csv\"\nsize = [0, 1]"),
                     ":6:8: instance[0].size: "},
             Refused{after("[[instance]]\nfile = \"a.csv\"\nmass = 0"), ":6:8: instance[0].mass: "},
         }) {
        expectRefused(refused);
    }
}

TEST_F(SceneErrors, MissingKeys) {
    for (const Refused& refused : {
             Refused{"[world]\nsize = [1, 1]\n", ":1:1: format: is missing"},
             Refused{"format = 1\n", ":1:1: world: is missing"},
             Refused{"format = 1\n[world]\n", ":2:1: world.size: "},
             Refused{after("[[spawn]]\ncount = 1"), ":4:1: spawn[0].pattern: is missing"},
             Refused{after("[[spawn]]\npattern = \"uniform\""), ":4:1: spawn[0].count: is missing"},
             Refused{group(""), ":4:1: spawn[0].size: "},
             Refused{after("[[body]]\nsize = [1, 1]"), ":4:1: body[0].position: is missing"},
             Refused{after("[[body]]\nposition = [0, 0]"), ":4:1: body[0].size: is missing"},
             Refused{after("[[instance]]\nsize = [1, 1]"), ":4:1: instance[0].file: is missing"},
             Refused{body("[[body]]\nposition = [0, 0]"), ":7:1: body[1].size: is missing"},
         }) {
        expectRefused(refused);
    }
}

TEST_F(SceneErrors, ConflictingKeys) {
    for (const Refused& refused : {
             Refused{after("area_per_body = 5"), ":4:17: world.area_per_body: "},
             Refused{after("aspect = 2"), ":4:10: world.aspect: "},
             Refused{group("size = [1, 1]\nside = [1, 2]"), ":8:8: spawn[0].side: "},
             Refused{group("size = [1, 1]\nmass = 1\ndensity = 1"), ":9:11: spawn[0].density: "},
             Refused{group("size = [1, 1]\njitter = 1"), ":8:10: spawn[0].jitter: "},
             Refused{body("static = true\nmass = 1"), ":8:8: body[0].mass: "},
             Refused{body("static = true\nvelocity = [0, 0]"), ":8:12: body[0].velocity: "},
         }) {
        expectRefused(refused);
    }
}

TEST_F(SceneErrors, UnknownKeyListsTheKnownOnes) {
    const auto file = folder_.write("scene.toml", walls("depth = 1"));
    const std::string error = errorOf<SceneError>([&] { loadScene(file); });
    EXPECT_NE(error.find("thickness, inset"), std::string::npos) << error;
}

TEST_F(SceneErrors, SyntaxErrors) {
    expectRefused({"format = \n", ":1:10: "});
    expectRefused({"format = 1\n[world\nsize = [1, 1]", ":2:7: "});
    expectRefused({after("size = [2, 2]"), ":4:8: "});
    expectRefused({after("\"\xff\" = 1"), ":4:"});
}

TEST_F(SceneErrors, TableRowsAndHeaders) {
    const std::string header = "x,y,vx,vy\n";
    expectTableRefused("", ":1:1: ");
    expectTableRefused("1,2,3,4\n", ":1:1: ");
    expectTableRefused("x,y,vx\n1,2,3\n", ":1:1: ");
    expectTableRefused("x,y,vx,vy,w\n1,2,3,4,5\n", ":1:1: ");
    expectTableRefused("x, y, vx, vy\n", ":1:1: ");
    expectTableRefused(header + "1,2,3\n", ":2:6: ");
    expectTableRefused(header + "1,2,3,4\n1,2,3,4,5\n", ":3:8: ");
    expectTableRefused(header + "1,2,3,4\n\n1,2,three,4\n", ":4:5: vx: ");
    expectTableRefused(header + "1,,3,4\n", ":2:3: y: ");
    expectTableRefused(header + "1,nan,3,4\n", ":2:3: y: ");
    expectTableRefused(header + "inf,2,3,4\n", ":2:1: x: ");
    expectTableRefused(header + "1e999,2,3,4\n", ":2:1: x: ");
    expectTableRefused(header + "1,2,3,4 \n", ":2:8: ");
    expectTableRefused("x,y,vx,vy,w,h\n1,2,3,4,0,1\n", ":2:9: w: ");
    expectTableRefused("x,y,vx,vy,w,h\n1,2,3,4,1,-1\n", ":2:11: h: ");
    expectTableRefused("x,y,vx,vy,w,h,mass\n1,2,3,4,5,6,0\n", ":2:13: mass: ");
    expectTableRefused("x,y,vx,vy,w,h\n1,2,3,4,5e-324,1\n", ":2:9: w: is too small");
    expectTableRefused("x,y,vx,vy,w,h\n1,2,3,4,1,5e-324\n", ":2:11: h: is too small");
}

/// Rows are counted before memory is taken for them.
TEST_F(SceneErrors, TablesOfTooManyRows) {
    folder_.write("table.csv", "x,y,vx,vy\n" + std::string(50'000'002, '\n'));
    expectWholeTableRefused("table.csv", "has more than 50000000 rows");
    folder_.write("table.csv", "x,y,vx,vy\n1,2,3,4\n1,2,3,4\nwrong\n");
    const auto scene = folder_.write("scene.toml", after("[[instance]]\nfile = \"table.csv\""));
    std::vector<std::uint64_t> announced;
    const auto announce = [&](std::uint64_t bodies, std::optional<Law>) {
        announced.push_back(bodies);
        throw Error("enough");
    };
    EXPECT_EQ(errorOf([&] { loadScene(scene, {.announce = announce}); }), "enough");
    ASSERT_EQ(announced.size(), 1u);
    EXPECT_GE(announced[0], 3u);
}

TEST_F(SceneErrors, FilesThatCannotBeRead) {
    const auto missing = folder_.path() / "missing.toml";
    EXPECT_TRUE(startsWith(errorOf<SceneError>([&] { loadScene(missing); }), missing.string()));
    EXPECT_THROW(loadScene(folder_.path()), SceneError);
    expectWholeTableRefused("missing.csv", "cannot be opened: ");
}

// Values that are right one by one.
TEST_F(SceneErrors, WhatCannotBeMadeOfPossibleValues) {
    expectRefused({"format = 1\n[world]\narea_per_body = 1e308\n" +
                       group("size = [1, 1]").substr(open.size()) +
                       "\n[[body]]\nposition = [0, 0]\nsize = [1, 1]",
                   ":3:17: world.area_per_body: world: size must be finite and positive"});
    expectRefused({"format = 1\n[world]\narea_per_body = 1\nwalls = { inset = 1 }",
                   ":4:9: world.walls: walls: the inset leaves no room inside the world"});
    expectRefused({walls("thickness = 1.7e308"),
                   ":4:9: world.walls: walls: they do not fit the precision of the world"});
    expectRefused({group("size = [1e200, 1e200]\ndensity = 1"), ":4:1: spawn[0]: entity 0: mass"});
    expectRefused({group("size = [1, 1]") +
                       group("side = [1e-200, 1e-200]\ndensity = 1").substr(open.size() - 1),
                   ":8:1: spawn[1]: entity 1: mass"});
    expectRefused({group("size = [1, 5e-324]"), ":7:8: spawn[0].size: is too small"});
    expectRefused({group("side = [5e-324, 1]"), ":7:8: spawn[0].side: is too small"});
    expectRefused({after("[[body]]\nposition = [0, 0]\nsize = [5e-324, 1]"),
                   ":6:8: body[0].size: is too small"});
}

// A region of numbers that are finite may still have a width that is not, or a shape without a
// lattice; bodies must not end up outside it, let alone the program.
TEST_F(SceneErrors, RegionsOfExtremeShapeAreTakenOrRefused) {
    for (const std::string pattern : {"uniform", "lattice"}) {
        for (const std::string region :
             {"[[-1.7e308, 0], [1.7e308, 1]]", "[[0, 0], [1e300, 1e-300]]",
              "[[0, 0], [1e-300, 1e300]]"}) {
            SCOPED_TRACE(pattern + " " + region);
            const auto file = folder_.write(
                "scene.toml", after("[[spawn]]\npattern = \"" + pattern +
                                    "\"\ncount = 5\nsize = [1, 1]\nregion = " + region));
            try {
                const Scene scene = loadScene(file);
                EXPECT_EQ(scene.world.movingCount(), 5u);
                for (std::uint32_t i = 0; i < 5; ++i) {
                    const Vec2 p = scene.world.get<Transform>(scene.world.at(i)).position;
                    EXPECT_TRUE(std::abs(p.x()) <= 1.7e308 && std::abs(p.y()) <= 1e300) << p;
                }
            } catch (const SceneError& error) {
                EXPECT_TRUE(startsWith(error.what(), file.string())) << error.what();
            }
        }
    }
}

}  // namespace
}  // namespace quadrille
