#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <vector>

#include "program.hpp"

namespace quadrille {
namespace {

/// One frame, so that a mistake that is overlooked costs no time.
const Arguments shortRun = {"--headless", "--frames", "1", "--entities", "10"};

void expectUsageError(const Arguments& arguments, const std::vector<std::string>& words) {
    expectRefusal(shortRun + arguments, 2, words);
}

TEST(Usage, UnknownOption) { expectUsageError({"--frobnicate"}, {"--frobnicate"}); }

TEST(Usage, OneScene) {
    expectUsageError({"balanced", "pile"}, {"pile"});
    expectUsageError({"--scene", "balanced", "pile"}, {"pile"});
    expectUsageError({"balancd"}, {"balancd", "balanced-scaled", "pile"});
    expectUsageError({"pile", "--load", "run.snapshot"}, {"--load", "scene"});
}

TEST(Usage, UnknownPartitionerListsTheValidOnes) {
    expectUsageError({"--partitioner", "octree"},
                     {"--partitioner", "octree", "brute-force", "static-grid", "quadtree",
                      "semi-static-quadtree"});
}

TEST(Usage, UnknownResolverListsTheValidOnes) {
    expectUsageError({"--resolver", "fpga"}, {"--resolver", "fpga", "auto", "sequential", "threads",
                                              "cuda", "cuda-resident"});
}

TEST(Usage, UnknownLawListsTheValidOnes) {
    expectUsageError({"--law", "newton"}, {"--law", "newton", "baseline", "impulse", "continuous"});
}

TEST(Usage, UnknownPrecisionListsTheValidOnes) {
    expectUsageError({"--precision", "half"}, {"--precision", "half", "double", "float"});
}

TEST(Usage, UnknownRebuildListsTheValidOnes) {
    expectUsageError({"--rebuild", "never"}, {"--rebuild", "never", "skin", "every:K"});
}

TEST(Usage, UnknownSceneListsTheValidOnes) {
    expectUsageError({"--scene", "balancd"}, {"--scene", "balancd", "balanced", "balanced-scaled",
                                              "bullet", "cradle", "demo13k", "gap", "imbalanced",
                                              "imbalanced-clear", "mixed-sizes", "pi", "pile"});
}

struct Mistyped {
    Arguments arguments;
    std::string hint;
};

void PrintTo(const Mistyped& mistyped, std::ostream* out) {
    *out << testing::PrintToString(mistyped.arguments);
}

class MistypedName : public testing::TestWithParam<Mistyped> {};

/// On the line of the error, which stands before it.
TEST_P(MistypedName, LeadsToTheNearestOnes) {
    const ProcessResult result = runProgram(shortRun + GetParam().arguments);
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(result.out, "");
    const std::string line = result.err.substr(0, result.err.find('\n'));
    EXPECT_TRUE(line.ends_with("; did you mean " + GetParam().hint + "?")) << line;
}

INSTANTIATE_TEST_SUITE_P(
    Usage, MistypedName,
    testing::Values(
        Mistyped{{"--presicion", "float"}, "'--precision'"},
        Mistyped{{"--presicion=float"}, "'--precision'"},
        Mistyped{{"--scene", "pile", "--presicion", "float"}, "'--precision'"},
        Mistyped{{"--presicion", "half", "--law", "newton"}, "'--precision'"},
        Mistyped{{"--lwa", "impulse", "--proflie"}, "'--law' or '--profile'"},
        Mistyped{{"--LAW", "impulse"}, "'--law'"}, Mistyped{{"-precision"}, "'--precision'"},
        Mistyped{{"--no-falback"}, "'--no-fallback'"},
        Mistyped{{"--windw-size"}, "'--window-size'"},
        Mistyped{{"--law", "continous"}, "'continuous'"},
        Mistyped{{"--partitioner", "quad-tree"}, "'quadtree'"},
        Mistyped{{"--precision", "duoble"}, "'double'"},
        Mistyped{{"--resolver", "cuda-residnt"}, "'cuda-resident'"},
        Mistyped{{"--cuda-thread", "bdoy"}, "'body'"},
        Mistyped{{"--show", "heatmap"}, "'heat-map'"},
        Mistyped{{"--show", "gridlines,contact"}, "'contacts'"},
        Mistyped{{"--color-by", "sped"}, "'speed'"}, Mistyped{{"--rebuild", "evry:10"}, "'every'"},
        Mistyped{{"--scene", "balaced"}, "'balanced'"}, Mistyped{{"balaced"}, "'balanced'"}),
    [](const auto& test) {
        return identifier(test.param.arguments.back()) + "_" + std::to_string(test.index);
    });

/// The snapshot excludes a scene, for which the value of the unknown option was taken.
TEST(Usage, UnknownOptionBesideASnapshot) {
    expectRefusal({"--headless", "--load", "run.snapshot", "--presicion", "float"}, 2,
                  {"--presicion", "did you mean '--precision'?"});
}

TEST(Usage, NamesThatAreFarFromAllLeadNowhere) {
    for (const Arguments& arguments :
         {Arguments{"--frobnicate"}, Arguments{"--law", "newton"}, Arguments{"--scene", "moon"},
          Arguments{"balanced", "pile"}}) {
        EXPECT_FALSE(contains(runProgram(shortRun + arguments).err, "did you mean"));
    }
}

std::string nameOf(const testing::TestParamInfo<Arguments>& test) {
    std::string words;
    for (const std::string& argument : test.param) words += argument;
    return identifier(words) + "_" + std::to_string(test.index);
}

class ImpossibleValue : public testing::TestWithParam<std::vector<std::string>> {};

/// The option is named, and the message does not drown the reader in digits.
TEST_P(ImpossibleValue, IsRefused) {
    const Arguments arguments = shortRun + GetParam();
    expectRefusal(arguments, 2, {GetParam()[GetParam().size() - 2]});
    EXPECT_LT(runProgram(arguments).err.size(), 300u);
}

INSTANTIATE_TEST_SUITE_P(
    Usage, ImpossibleValue,
    testing::Values(
        Arguments{"--dt", "0"}, Arguments{"--dt", "-1"}, Arguments{"--dt", "nan"},
        Arguments{"--dt", "inf"}, Arguments{"--dt", "fast"}, Arguments{"--restitution", "1.5"},
        Arguments{"--restitution", "-0.1"}, Arguments{"--restitution", "nan"},
        Arguments{"--max-depth", "16"}, Arguments{"--max-depth", "-1"},
        Arguments{"--max-per-cell", "0"}, Arguments{"--cell-size", "0,3"},
        Arguments{"--cell-size", "3,-3"}, Arguments{"--cell-size", "3x3"},
        Arguments{"--cell-size", "1,2,3"}, Arguments{"--cell-size", "nan"},
        Arguments{"--partitioner", "static-grid", "--cell-size", "0,3"},
        Arguments{"--partitioner", "static-grid", "--cell-size", "3x3"},
        Arguments{"--rebuild", "every:0"}, Arguments{"--rebuild", "every:2.5"},
        Arguments{"--rebuild", "every:"}, Arguments{"--rebuild", "skin:0"},
        Arguments{"--rebuild", "skin:-1"},
        Arguments{"--partitioner", "quadtree", "--rebuild", "never"}, Arguments{"--duration", "0"},
        Arguments{"--duration", "-1"}, Arguments{"--duration", "nan"},
        Arguments{"--report-every", "0"}, Arguments{"--report-every", "nan"},
        Arguments{"--set", "dt"}, Arguments{"--set", ""}, Arguments{"--json", ""},
        Arguments{"--save", ""}, Arguments{"--save", "-"}, Arguments{"--screenshot", ""},
        Arguments{"--screenshot", "-"}, Arguments{"--size", "640"}, Arguments{"--size", "640x"},
        Arguments{"--size", "0x480"}, Arguments{"--size", "640x480x2"},
        Arguments{"--size", "640;480"}, Arguments{"--size", "9e3x480"}, Arguments{"--speed", "0"},
        Arguments{"--speed", "-1"}, Arguments{"--speed", "nan"}, Arguments{"--speed", "fast"},
        Arguments{"--history", "much"}, Arguments{"--history", "-1MB"},
        Arguments{"--history", "5TB"}, Arguments{"--show", "cells"},
        Arguments{"--show", "gridlines,cells"}, Arguments{"--color-by", "mass"},
        Arguments{"--threads", "0"}, Arguments{"--threads", "-1"}, Arguments{"--threads", "1.5"},
        Arguments{"--threads", "many"}, Arguments{"--threads", "1025"},
        Arguments{"--threads", "99999999999999999999"}),
    nameOf);

class ImpossibleCount : public testing::TestWithParam<std::vector<std::string>> {};

/// These are given once only; a wrapped or cut count would run nearly for ever, so a short duration
/// bounds the run.
TEST_P(ImpossibleCount, IsRefused) {
    expectRefusal(Arguments{"--headless", "--scene", "demo13k", "--duration", "0.05"} + GetParam(),
                  2, {GetParam()[0]});
}

INSTANTIATE_TEST_SUITE_P(Usage, ImpossibleCount,
                         testing::Values(Arguments{"--frames", "-1"}, Arguments{"--frames", "many"},
                                         Arguments{"--frames", "1.5"}, Arguments{"--frames", ""},
                                         Arguments{"--frames", "99999999999999999999999"},
                                         Arguments{"--entities", "-5"},
                                         Arguments{"--entities", "few"}, Arguments{"--seed", "-1"},
                                         Arguments{"--seed", "x"}),
                         nameOf);

TEST(Usage, MissingValues) {
    for (const char* option :
         {"--scene",        "--set",          "--seed",       "--partitioner", "--cell-size",
          "--max-depth",    "--max-per-cell", "--rebuild",    "--resolver",    "--threads",
          "--law",          "--precision",    "--dt",         "--restitution", "--duration",
          "--report-every", "--json",         "--csv",        "--dump-state",  "--dump-events",
          "--save",         "--load",         "--screenshot", "--save-every",  "--compare"}) {
        expectUsageError({option}, {option});
    }
    expectRefusal({"--headless", "--frames"}, 2, {"--frames"});
    expectRefusal({"--headless", "--entities"}, 2, {"--entities"});
}

TEST(Usage, SavingNowAndThenNeedsAFileAndFrames) {
    expectUsageError({"--save-every", "5"}, {"--save-every", "requires", "--save"});
    for (const char* frames : {"0", "-1", "1.5", "00", "often"}) {
        expectUsageError({"--save", "/no/such/folder/snapshot", "--save-every", frames},
                         {"--save-every", frames});
    }
}

TEST(Usage, OptionGivenTwice) {
    expectRefusal({"--headless", "--frames", "1", "--frames", "2"}, 2, {"--frames"});
}

TEST(Usage, SnapshotExcludesWhatMakesAScene) {
    const Arguments load = {"--headless", "--frames", "1", "--load", "run.snapshot"};
    expectRefusal(load + Arguments{"--scene", "pile"}, 2, {"--load", "--scene"});
    expectRefusal(load + Arguments{"--entities", "5"}, 2, {"--load", "--entities"});
    expectRefusal(load + Arguments{"--seed", "5"}, 2, {"--load", "--seed"});
    expectRefusal(load + Arguments{"--set", "step.dt=1"}, 2, {"--load", "--set"});
}

TEST(Usage, OneOutputOnStdout) {
    expectUsageError({"--json", "-", "--csv", "-"}, {"stdout"});
    expectUsageError({"--dump-state", "-", "--dump-events", "-"}, {"stdout"});
    expectUsageError({"--csv", "-", "--dump-state", "-"}, {"stdout"});
}

TEST(Usage, LawThatNeedsACompletePartition) {
    expectUsageError({"--law", "continuous", "--rebuild", "every:10"}, {"misses no pair"});
}

TEST(Usage, CellsTooSmallForTheWorld) {
    for (const char* size : {"0.001", "1e-300", "0.05,0.05", "1000,0.001"}) {
        expectUsageError({"--partitioner", "static-grid", "--cell-size", size}, {"--cell-size"});
    }
}

TEST(Usage, NoScreenshotWithoutAWindow) {
    expectUsageError({"--screenshot", "shot.png"}, {"--screenshot", "--headless"});
    expectUsageError({"--offscreen"}, {"--offscreen", "--headless"});
}

}  // namespace
}  // namespace quadrille
