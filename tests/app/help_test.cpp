#include <gtest/gtest.h>
#include <string>

#include <quadrille/version.hpp>

#include "program.hpp"

namespace quadrille {
namespace {

TEST(Help, ListsEveryOption) {
    const ProcessResult result = runProgram({"--help"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    for (const char* option :
         {"--scene",       "--entities",     "--seed",         "--partitioner", "--cell-size",
          "--max-depth",   "--max-per-cell", "--rebuild",      "--resolver",    "--threads",
          "--law",         "--precision",    "--dt",           "--restitution", "--headless",
          "--frames",      "--duration",     "--report-every", "--profile",     "--error",
          "--explain",     "--json",         "--csv",          "--dump-state",  "--dump-events",
          "--save",        "--load",         "--screenshot",   "--no-fallback", "--list",
          "--version",     "--help",         "--window-size",  "--size",        "--offscreen",
          "--hide-panels", "--paused",       "--speed",        "--show",        "--color-by",
          "--no-vsync",    "--force-memory", "--set",          "--save-every",  "--generate",
          "--compare",     "--history"}) {
        EXPECT_TRUE(contains(result.out, option)) << option;
    }
}

TEST(Help, NamesTheValuesOfEnumeratedOptions) {
    const std::string help = runProgram({"--help"}).out;
    for (const char* value :
         {"brute-force", "static-grid", "quadtree", "semi-static-quadtree", "skin", "every:K",
          "auto", "sequential", "threads", "cuda", "cuda-resident", "baseline", "impulse",
          "continuous", "double", "float", "balanced", "26,26"}) {
        EXPECT_TRUE(contains(help, value)) << value;
    }
}

TEST(Help, ExplainsTheExitCodes) {
    const std::string help = runProgram({"--help"}).out;
    for (const char* text :
         {"0 done", "1 run-time failure", "2 usage", "3 bad scene", "4 no such", "128 + N"}) {
        EXPECT_TRUE(contains(help, text)) << text;
    }
}

TEST(Version, NamesVersionAndCommit) {
    const ProcessResult result = runProgram({"--version"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.out, std::string("collisionStress ") + version + " (" + commit() + ")\n");
}

TEST(List, NamesScenesAndChoices) {
    const ProcessResult result = runProgram({"--list"});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    for (const char* name :
         {"balanced", "balanced-scaled", "bullet", "cradle", "demo13k", "imbalanced",
          "imbalanced-clear", "mixed-sizes", "pi", "pile", "brute-force", "static-grid", "quadtree",
          "semi-static-quadtree", "sequential", "baseline", "impulse", "double", "float"}) {
        EXPECT_TRUE(contains(result.out, name)) << name;
    }
}

/// Be it that the build has no window or that there is no display to open one on: no driver is
/// chosen here, so that one which shows nothing may offer itself.
class Window : public testing::TestWithParam<Arguments> {};

TEST_P(Window, IsMissedWithAHint) {
    Process program("/usr/bin/env",
                    Arguments{"-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", "-u", "SDL_VIDEODRIVER"} +
                        GetParam() + Arguments{QUADRILLE_PROGRAM, "--scene", "cradle"});
    const ProcessResult result = program.finish();
    EXPECT_FALSE(result.timedOut);
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(contains(result.err, "--headless")) << result.err;
}

INSTANTIATE_TEST_SUITE_P(Where, Window,
                         testing::Values(Arguments{}, Arguments{"DISPLAY=:4711"},
                                         Arguments{"DISPLAY=nowhere"}, Arguments{"DISPLAY="},
                                         Arguments{"SDL_VIDEODRIVER=offscreen"},
                                         Arguments{"SDL_VIDEODRIVER=dummy"},
                                         Arguments{"SDL_VIDEODRIVER=x11"}),
                         [](const auto& test) {
                             return test.param.empty() ? "nothing" : identifier(test.param.front());
                         });

}  // namespace
}  // namespace quadrille
