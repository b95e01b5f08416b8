#include <algorithm>
#include <fcntl.h>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

#include "program.hpp"

namespace quadrille {
namespace {

namespace fs = std::filesystem;

const Arguments cradle = {"--headless", "--scene", "cradle", "--frames", "5"};
const std::vector<std::string> outputOptions = {"--json", "--csv", "--dump-state", "--dump-events",
                                                "--save"};

class OutputFiles : public ProgramTest {
  protected:
    /// Its body leaves the range of numbers in the first step.
    std::string failingScene() const {
        return write("failing.toml",
                     "format = 1\n"
                     "[world]\n"
                     "size = [100, 100]\n"
                     "[step]\n"
                     "dt = 1000\n"
                     "[[body]]\n"
                     "position = [0, 0]\n"
                     "size = [1, 1]\n"
                     "velocity = [1e308, 0]\n");
    }
};

class UnwritableOutput : public OutputFiles, public testing::WithParamInterface<std::string> {};

/// Nothing on stdout: not a frame was computed for a result that cannot be kept.
TEST_P(UnwritableOutput, InAMissingFolderFailsBeforeTheRun) {
    const std::string target = file("missing/result");
    expectRefusal(cradle + Arguments{GetParam(), target}, 1, {target});
    EXPECT_TRUE(files().empty());
}

TEST_P(UnwritableOutput, WithTheNameOfAFolderFailsBeforeTheRun) {
    fs::create_directory(path("folder"));
    expectRefusal(cradle + Arguments{GetParam(), file("folder")}, 1, {file("folder")});
    EXPECT_EQ(files(), std::vector<std::string>{"folder"});
}

TEST_P(UnwritableOutput, LeavesTheOtherFilesAsTheyWere) {
    for (const std::string& other : outputOptions) {
        if (other == GetParam()) continue;
        SCOPED_TRACE(other);
        write("kept", "old");
        const ProcessResult result =
            runProgram(cradle + Arguments{other, file("kept"), GetParam(), file("missing/result")});
        EXPECT_EQ(result.exitCode, 1);
        EXPECT_EQ(contentOf(path("kept")), "old");
        EXPECT_EQ(files(), std::vector<std::string>{"kept"});
    }
}

INSTANTIATE_TEST_SUITE_P(OutputFiles, UnwritableOutput, testing::ValuesIn(outputOptions),
                         [](const auto& test) { return identifier(test.param); });

TEST_F(OutputFiles, StayAsTheyWereIfTheRunFails) {
    Arguments run = {"--headless", "--frames", "50", "--scene", failingScene()};
    std::vector<std::string> expected = {"failing.toml"};
    for (const std::string& option : outputOptions) {
        const std::string name = "old" + option;
        run.push_back(option);
        run.push_back(write(name, "old"));
        expected.push_back(name);
    }
    const ProcessResult result = runProgram(run);
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_TRUE(contains(result.err, "finite")) << result.err;
    for (const std::string& option : outputOptions) {
        EXPECT_EQ(contentOf(path("old" + option)), "old") << option;
    }
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(files(), expected);
}

TEST_F(OutputFiles, AreReplacedByARunThatEnds) {
    write("run.json", "old");
    EXPECT_EQ(runProgram(cradle + Arguments{"--json", file("run.json")}).exitCode, 0);
    EXPECT_EQ(Json::parse(contentOf(path("run.json")))["scene"], "cradle");
    EXPECT_EQ(files(), std::vector<std::string>{"run.json"});
}

TEST_F(OutputFiles, OfOneNameAreAConflict) {
    expectRefusal(cradle + Arguments{"--json", file("same"), "--csv", file("same")}, 2, {"--csv"});
    expectRefusal(cradle + Arguments{"--dump-state", file("same"), "--save", file("same")}, 2,
                  {"--save"});
    EXPECT_TRUE(files().empty());
}

TEST_F(OutputFiles, AreReachedThroughALink) {
    write("target.json", "old");
    fs::create_symlink(path("target.json"), path("link.json"));
    EXPECT_EQ(runProgram(cradle + Arguments{"--json", file("link.json")}).exitCode, 0);
    EXPECT_TRUE(fs::is_symlink(path("link.json")));
    EXPECT_EQ(Json::parse(contentOf(path("target.json")), nullptr, false)["scene"], "cradle");
}

/// A pipe stands here for /dev/null and its like, which a run of the superuser must not replace.
class SpecialFile : public OutputFiles, public testing::WithParamInterface<std::string> {};

TEST_P(SpecialFile, IsNotReplaced) {
    ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
    // With a reader, opening the pipe does not wait; nothing of this size fills it.
    const int reader = open(file("pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(reader, 0);
    runProgram(cradle + Arguments{GetParam(), file("pipe")});
    EXPECT_TRUE(fs::is_fifo(path("pipe")));
    close(reader);
}

INSTANTIATE_TEST_SUITE_P(OutputFiles, SpecialFile, testing::ValuesIn(outputOptions),
                         [](const auto& test) { return identifier(test.param); });

}  // namespace
}  // namespace quadrille
