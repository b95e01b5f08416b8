#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"

namespace quadrille {
namespace {

class Input : public ProgramTest {
  protected:
    void expectBadScene(const std::string& scene, const std::vector<std::string>& words) const {
        expectRefusal({"--headless", "--frames", "1", "--scene", scene}, 3, words);
    }
    void expectBadSnapshot(const std::string& snapshot) const {
        expectRefusal({"--headless", "--frames", "1", "--load", snapshot}, 3, {snapshot});
    }
};

TEST_F(Input, WrongValueIsLocated) {
    const std::string scene = write("bad.toml",
                                    "format = 1\n"
                                    "[world]\n"
                                    "size = [100, 100]\n"
                                    "[step]\n"
                                    "dt = -1\n");
    expectBadScene(scene, {scene + ":5:", "step.dt", "positive"});
    expectBadScene(scene, {scene + ":5:6: "});
}

TEST_F(Input, UnknownKeyIsLocated) {
    const std::string scene = write("bad.toml",
                                    "format = 1\n"
                                    "[world]\n"
                                    "size = [100, 100]\n"
                                    "[[spawn]]\n"
                                    "pattern = \"lattice\"\n"
                                    "count = 5\n"
                                    "size = [3, 3]\n"
                                    "  colour = \"#226666\"\n");
    expectBadScene(scene, {scene + ":8:", "spawn[0].colour", "color"});
}

TEST_F(Input, WrongTypeIsLocated) {
    const std::string scene = write("bad.toml",
                                    "format = 1\n"
                                    "[world]\n"
                                    "size = \"large\"\n");
    expectBadScene(scene, {scene + ":3:", "world.size"});
}

TEST_F(Input, SyntaxErrorIsLocated) {
    const std::string scene = write("bad.toml", "format = 1\n[world\n");
    expectBadScene(scene, {scene + ":2:"});
}

TEST_F(Input, WrongRowOfAnInstanceFileIsLocated) {
    const std::string csv = write("crystal.csv", "x,y,vx,vy\n0,0,1,1\n5,oops,1,1\n");
    const std::string scene = write("crystal.toml",
                                    "format = 1\n"
                                    "[world]\n"
                                    "size = [100, 100]\n"
                                    "[[instance]]\n"
                                    "file = \"crystal.csv\"\n"
                                    "size = [3, 3]\n");
    expectBadScene(scene, {csv + ":3:3: ", "y"});
}

TEST_F(Input, MissingScene) {
    expectBadScene(file("missing.toml"), {file("missing.toml")});
    expectBadScene(file("no/folder/missing.toml"), {"no/folder/missing.toml"});
}

TEST_F(Input, FolderIsNoScene) { expectBadScene(file("."), {file(".")}); }

TEST_F(Input, MissingSnapshot) { expectBadSnapshot(file("missing")); }

TEST_F(Input, FolderIsNoSnapshot) {
    std::filesystem::create_directory(path("folder"));
    expectBadSnapshot(file("folder"));
}

TEST_F(Input, OtherFileIsNoSnapshot) {
    expectBadSnapshot(write("empty", ""));
    expectBadSnapshot(write("short", "abc"));
    expectBadSnapshot(shippedScene("balanced").string());
}

TEST_F(Input, DamagedSnapshot) {
    const ProcessResult saved =
        runProgram({"--headless", "--scene", "cradle", "--frames", "5", "--save", file("good")});
    ASSERT_EQ(saved.exitCode, 0) << saved.err;
    const std::string good = contentOf(path("good"));
    ASSERT_GT(good.size(), 100u);
    std::string flipped = good;
    flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 1);
    expectBadSnapshot(write("flipped", flipped));
    expectBadSnapshot(write("cut", good.substr(0, good.size() - 9)));
    expectBadSnapshot(write("longer", good + "x"));
}

TEST_F(Input, SceneByPath) {
    std::filesystem::copy_file(shippedScene("cradle"), path("copy.toml"));
    const Arguments frames = {"--frames", "10"};
    const Json byName = summaryOf(Arguments{"--scene", "cradle"} + frames);
    const Json byPath = summaryOf(Arguments{"--scene", file("copy.toml")} + frames);
    EXPECT_EQ(byPath["state_hash"], byName["state_hash"]);
    EXPECT_EQ(byPath["scene"], "cradle");
}

TEST_F(Input, SceneWithoutSpawnGroupHasNoCount) {
    const ProcessResult result =
        runProgram({"--headless", "--frames", "1", "--scene", "cradle", "--entities", "4"});
    EXPECT_TRUE(result.exitCode == 2 || result.exitCode == 3) << result.exitCode;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(contains(result.err, "no spawn group")) << result.err;
}

}  // namespace
}  // namespace quadrille
