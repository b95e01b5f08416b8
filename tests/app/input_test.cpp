#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <vector>

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

TEST_F(Input, SceneNeedsNoOption) {
    EXPECT_EQ(summaryOf({"cradle", "--frames", "1"})["scene"], "cradle");
    EXPECT_EQ(summaryOf({"--frames", "1", "--set", "seed=3", "pile"})["scene"], "pile");
    EXPECT_EQ(summaryOf({"--frames", "1", "--show", "gridlines", "pile"})["scene"], "pile");
    const std::string scene = write("own.toml", "format = 1\n[world]\nsize = [9, 9]\n");
    EXPECT_EQ(summaryOf({scene, "--frames", "1"})["scene"], "own");
}

TEST_F(Input, SettingsGoBeforeTheScene) {
    const Json summary = summaryOf({"--scene", "balanced", "--set", "spawn.0.count=50", "--set",
                                    "step.restitution=0.5", "--set", "step.law=\"impulse\"",
                                    "--set", "world.size=[400, 300]", "--frames", "1"});
    EXPECT_EQ(summary["entities"], 50);
    EXPECT_EQ(summary["restitution"], 0.5);
    EXPECT_EQ(summary["law"], "impulse");
    // Options of their own go before them.
    const Json options =
        summaryOf({"--set", "spawn.0.count=50", "--set", "step.dt=0.5", "--set", "seed=3",
                   "--entities", "60", "--dt", "0.25", "--seed", "4", "--frames", "0"});
    EXPECT_EQ(options["entities"], 60);
    EXPECT_EQ(options["dt"], 0.25);
    EXPECT_EQ(options["seed"], 4);
}

TEST_F(Input, WrongSettingIsNamed) {
    const Arguments run = {"--headless", "--frames", "1", "--set"};
    expectRefusal(run + Arguments{"step.restitution=2"}, 3,
                  {"--set: step.restitution: must be from 0 to 1"});
    expectRefusal(run + Arguments{"spawn.0.colour=#fff"}, 3,
                  {"--set: spawn[0].colour: is not a known key; known here: "});
    expectRefusal(run + Arguments{"spawn.0.count=many"}, 3,
                  {"--set: spawn[0].count: must be an integer"});
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

// ---- inputs that never end

/// Nothing waits for them, and nothing is allocated for them.
class EndlessInput : public Input {
  protected:
    void expectRefusedAtOnce(const Arguments& arguments, const std::string& name) const {
        SCOPED_TRACE(name);
        Process process(QUADRILLE_PROGRAM, Arguments{"--headless", "--frames", "1"} + arguments);
        const ProcessResult result = process.finish(Process::Seconds(30));
        EXPECT_FALSE(result.timedOut);
        EXPECT_EQ(result.exitCode, 3) << result.err;
        EXPECT_TRUE(contains(result.err, name + ": ")) << result.err;
    }

    /// What is no regular file, by a name in the folder.
    std::vector<std::string> specialFiles() const {
        EXPECT_EQ(mkfifo(file("pipe.toml").c_str(), 0600), 0);
        std::filesystem::create_directory(path("folder.toml"));
        std::vector<std::string> names = {file("pipe.toml"), file("folder.toml")};
        for (const char* device : {"/dev/zero", "/dev/random", "/dev/null", "/dev/full"}) {
            const std::string link = identifier(device) + ".toml";
            std::filesystem::create_symlink(device, path(link));
            names.push_back(file(link));
        }
        return names;
    }
};

TEST_F(EndlessInput, IsNoScene) {
    for (const std::string& name : specialFiles()) expectRefusedAtOnce({"--scene", name}, name);
}

TEST_F(EndlessInput, IsNoSnapshot) {
    for (const std::string& name : specialFiles()) expectRefusedAtOnce({"--load", name}, name);
}

TEST_F(EndlessInput, IsNoInstanceFile) {
    for (const std::string& name : specialFiles()) {
        const std::string scene = write("scene.toml",
                                        "format = 1\n"
                                        "[world]\n"
                                        "size = [100, 100]\n"
                                        "[[instance]]\n"
                                        "file = \"" +
                                            name + "\"\n");
        expectRefusedAtOnce({"--scene", scene}, name);
    }
}

/// Their length is known, and no memory holds it: a file with holes takes no disk.
TEST_F(EndlessInput, IsAFileLargerThanTheMemory) {
    const std::string name = write("large.toml", "x,y,vx,vy\n");
    std::error_code error;
    std::filesystem::resize_file(path("large.toml"), std::uintmax_t(1) << 42, error);
    if (error) GTEST_SKIP() << error.message();
    expectRefusedAtOnce({"--scene", name}, name);
    expectRefusedAtOnce({"--load", name}, name);
    const std::string scene = write("scene.toml",
                                    "format = 1\n"
                                    "[world]\n"
                                    "size = [100, 100]\n"
                                    "[[instance]]\n"
                                    "file = \"large.toml\"\n");
    expectRefusedAtOnce({"--scene", scene}, name);
}

TEST_F(EndlessInput, IsACountThatNoMemoryHolds) {
    std::string text = "format = 1\n[world]\nsize = [100, 100]\n";
    for (int i = 0; i < 1000; ++i) {
        text += "[[spawn]]\npattern = \"uniform\"\ncount = 50000000\nsize = [1, 1]\n";
    }
    const std::string scene = write("scene.toml", text);
    expectBadScene(scene, {scene, "50000000000 bodies", "bytes of memory", "--force-memory"});
    expectRefusal({"--explain", "--scene", scene}, 3, {"bytes of memory"});
    expectRefusal({"--headless", "--frames", "1", "--entities", "100000000000"}, 3,
                  {"50000000 bodies"});
}

#ifndef __SANITIZE_ADDRESS__
/// A limit that a shell sets counts like the memory of the machine; a run that is forced takes what
/// it gets.
TEST_F(EndlessInput, IsWhatALimitForbids) {
    const auto limited = [](const Arguments& more) {
        Process shell("/bin/sh",
                      Arguments{"-c", "ulimit -v 2000000; exec \"$@\"", "sh", QUADRILLE_PROGRAM,
                                "--headless", "--frames", "1", "--scene", "balanced-scaled"} +
                          more);
        return shell.finish();
    };
    const ProcessResult refused = limited({"--entities", "50000000"});
    EXPECT_EQ(refused.exitCode, 3) << refused.err;
    EXPECT_TRUE(contains(refused.err, "50000000 bodies need about")) << refused.err;
    EXPECT_TRUE(contains(refused.err, "there are 2048000000 (2.05 GB)")) << refused.err;
    const ProcessResult forced = limited({"--entities", "50000000", "--force-memory"});
    EXPECT_EQ(forced.exitCode, 1);
    EXPECT_TRUE(contains(forced.err, "out of memory")) << forced.err;
    EXPECT_EQ(limited({"--entities", "1000"}).exitCode, 0);

    // Room for the bodies, but not for a run.
    ASSERT_EQ(runProgram({"--headless", "--scene", "balanced-scaled", "--entities", "1000000",
                          "--frames", "0", "--save", file("snapshot")})
                  .exitCode,
              0);
    Process shell("/bin/sh", {"-c", "ulimit -v 200000; exec \"$@\"", "sh", QUADRILLE_PROGRAM,
                              "--headless", "--frames", "1", "--load", file("snapshot")});
    const ProcessResult loaded = shell.finish();
    EXPECT_EQ(loaded.exitCode, 3) << loaded.err;
    EXPECT_TRUE(contains(loaded.err, file("snapshot") + ": 1000000 bodies need")) << loaded.err;
}
#endif

// ---- values that do not fit

TEST_F(Input, ValuesBeyondSinglePrecision) {
    const auto sceneWith = [&](const std::string& step, const std::string& body) {
        return write("wide.toml", "format = 1\n[world]\nsize = [100, 100]\n[step]\n" + step +
                                      "\n[[body]]\n" + body);
    };
    const std::string body = "position = [0, 0]\nsize = [1, 1]\n";
    for (const std::string& scene :
         {sceneWith("", "position = [1e300, 0]\nsize = [1, 1]\n"),
          sceneWith("", "position = [0, 0]\nsize = [1e-300, 1]\n"),
          sceneWith("", body + "velocity = [0, 1e39]\n"), sceneWith("", body + "mass = 1e-60\n"),
          sceneWith("", body + "mass = 1e60\n"), sceneWith("dt = 1e-60", body),
          sceneWith("gravity = [0, -1e39]", body)}) {
        SCOPED_TRACE(contentOf(scene));
        expectRefusal({"--headless", "--frames", "0", "--precision", "float", "--scene", scene}, 3,
                      {scene + ": ", "fit"});
        EXPECT_EQ(runProgram({"--headless", "--frames", "0", "--scene", scene}).exitCode, 0);
    }
    expectRefusal({"--headless", "--frames", "0", "--precision", "float", "--scene", "cradle",
                   "--dt", "1e-60"},
                  2, {"--dt"});
}

TEST_F(Input, JitterBeyondTheRangeOfNumbers) {
    const std::string scene = write("jitter.toml",
                                    "format = 1\n"
                                    "[world]\n"
                                    "size = [100, 100]\n"
                                    "[[spawn]]\n"
                                    "pattern = \"lattice\"\n"
                                    "count = 9\n"
                                    "size = [3, 3]\n"
                                    "jitter = 1.7e308\n");
    expectBadScene(scene, {scene + ":8:10: spawn[0].jitter: is too large"});
}

/// Some editors begin every text with one.
TEST_F(Input, ByteOrderMarks) {
    const std::string mark = "\xef\xbb\xbf";
    const std::string text =
        "format = 1\n[world]\nsize = [100, 100]\n[[instance]]\nfile = \"rows.csv\"\n";
    write("rows.csv", "x,y,vx,vy\r\n1,2,3,4\r\n");
    const Json plain = summaryOf({"--scene", write("a.toml", text), "--frames", "1"});
    write("rows.csv", mark + "x,y,vx,vy\r\n1,2,3,4\r\n");
    const Json marked = summaryOf({"--scene", write("a.toml", mark + text), "--frames", "1"});
    EXPECT_EQ(marked["entities"], 1);
    EXPECT_EQ(marked["state_hash"], plain["state_hash"]);
    write("rows.csv", mark + mark + "x,y,vx,vy\n1,2,3,4\n");
    expectBadScene(file("a.toml"), {file("rows.csv") + ":1:1: "});
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
