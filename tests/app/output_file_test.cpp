#include <algorithm>
#include <fcntl.h>
#include <filesystem>
#include <gtest/gtest.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
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
    EXPECT_EQ(parseJson(contentOf(path("run.json")))["scene"], "cradle");
    EXPECT_EQ(files(), std::vector<std::string>{"run.json"});
}

/// Every way to give one file two names.
TEST_F(OutputFiles, OfOneFileAreAConflict) {
    write("old", "old");
    fs::create_directory(path("folder"));
    fs::create_symlink("old", path("link"));
    fs::create_symlink("link", path("link-to-link"));
    fs::create_symlink("new", path("dangling"));
    fs::create_symlink(".", path("here"));
    fs::create_hard_link(path("old"), path("hard"));
    const std::vector<std::string> before = files();
    const std::vector<std::pair<std::string, std::string>> pairs = {{"old", "old"},
                                                                    {"new", "new"},
                                                                    {"new", "folder/../new"},
                                                                    {"new", "./new"},
                                                                    {"old", "link"},
                                                                    {"old", "hard"},
                                                                    {"link", "hard"},
                                                                    {"hard", "link-to-link"},
                                                                    {"new", "dangling"},
                                                                    {"new", "here/new"},
                                                                    {"old", "here/./old"},
                                                                    {"here/new", "dangling"},
                                                                    {"dangling", "here/dangling"}};
    for (const auto& [first, second] : pairs) {
        SCOPED_TRACE(first + " and " + second);
        expectRefusal(cradle + Arguments{"--json", file(first), "--csv", file(second)}, 2,
                      {"--json", "--csv"});
        expectRefusal(cradle + Arguments{"--save", file(first), "--dump-state", file(second)}, 2,
                      {"--save", "--dump-state"});
    }
    EXPECT_EQ(files(), before);
    EXPECT_EQ(contentOf(path("old")), "old");
}

TEST_F(OutputFiles, OfOneFileAreAConflictWhereverTheProgramIs) {
    Process shell("/bin/sh",
                  Arguments{"-c", "cd \"$0\" && exec \"$@\"", file("."), QUADRILLE_PROGRAM} +
                      cradle + Arguments{"--json", "a", "--csv", "./a"});
    const ProcessResult result = shell.finish();
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_TRUE(contains(result.err, "--json and --csv")) << result.err;
    EXPECT_TRUE(files().empty());
}

TEST_F(OutputFiles, AreNoConflictWithANeighbour) {
    write("x.part", "of the user");
    const ProcessResult result =
        runProgram(cradle + Arguments{"--json", file("x"), "--save", file("y"), "--csv",
                                      "/dev/null", "--dump-events", "/dev/null"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(contentOf(path("x.part")), "of the user");
    EXPECT_EQ(files(), (std::vector<std::string>{"x", "x.part", "y"}));
}

TEST_F(OutputFiles, MayHaveTheNameOfAnotherWithAnEnding) {
    ASSERT_EQ(
        runProgram(cradle + Arguments{"--json", file("x"), "--save", file("x.part")}).exitCode, 0);
    EXPECT_EQ(parseJson(contentOf(path("x")))["scene"], "cradle");
    summaryOf({"--load", file("x.part"), "--frames", "0"});
    EXPECT_EQ(files(), (std::vector<std::string>{"x", "x.part"}));
}

TEST_F(OutputFiles, DoNotReplaceAnInput) {
    fs::copy_file(shippedScene("cradle"), path("scene.toml"));
    const std::string scene = contentOf(path("scene.toml"));
    const Arguments run = {"--headless", "--frames", "1"};
    expectRefusal(run + Arguments{"--scene", file("scene.toml"), "--json", file("./scene.toml")}, 2,
                  {"--scene", "--json"});
    ASSERT_EQ(runProgram(cradle + Arguments{"--save", file("snapshot")}).exitCode, 0);
    expectRefusal(run + Arguments{"--load", file("snapshot"), "--csv", file("snapshot")}, 2,
                  {"--load", "--csv"});
    EXPECT_EQ(contentOf(path("scene.toml")), scene);
    // The next snapshot may take the place of the last.
    summaryOf({"--load", file("snapshot"), "--save", file("snapshot"), "--frames", "5"});
    EXPECT_EQ(summaryOf({"--load", file("snapshot"), "--frames", "0"})["steps_done"], 10);
}

/// The words of the run go there already.
TEST_F(OutputFiles, AreNotWhereStdoutOrStderrGoes) {
    for (const char* redirection : {">", "2>", ">>"}) {
        Process shell(
            "/bin/sh",
            Arguments{"-c", "out=$1; shift; exec \"$@\" " + std::string(redirection) + " \"$out\"",
                      "sh", file("log"), QUADRILLE_PROGRAM} +
                cradle + Arguments{"--json", file("log")});
        EXPECT_EQ(shell.finish().exitCode, 2) << redirection;
    }
}

TEST_F(OutputFiles, KeepTheirPermissions) {
    for (const mode_t mode : {0600, 0640, 0664, 0444}) {
        for (const std::string& option : outputOptions) {
            write("old", "old");
            ASSERT_EQ(chmod(file("old").c_str(), mode), 0);
            EXPECT_EQ(runProgram(cradle + Arguments{option, file("old")}).exitCode, 0);
            struct stat state {};
            ASSERT_EQ(stat(file("old").c_str(), &state), 0);
            EXPECT_EQ(state.st_mode & 07777, mode) << option;
            EXPECT_NE(contentOf(path("old")), "old") << option;
            fs::remove(path("old"));
        }
    }
}

TEST_F(OutputFiles, TakeTheirPermissionsFromTheUmask) {
    for (const std::string& option : outputOptions) {
        Process shell("/bin/sh",
                      Arguments{"-c", "umask 027; exec \"$@\"", "sh", QUADRILLE_PROGRAM} + cradle +
                          Arguments{option, file("new")});
        EXPECT_EQ(shell.finish().exitCode, 0);
        struct stat state {};
        ASSERT_EQ(stat(file("new").c_str(), &state), 0);
        EXPECT_EQ(state.st_mode & 07777, 0640u) << option;
        fs::remove(path("new"));
    }
}

/// Two runs that write one name at the same time: the file is the whole result of one of them.
TEST_F(OutputFiles, OfTwoRunsAtOnceAreWhole) {
    for (int round = 0; round < 6; ++round) {
        std::vector<std::unique_ptr<Process>> runs;
        for (const char* count : {"3000", "4000"}) {
            runs.push_back(std::make_unique<Process>(
                QUADRILLE_PROGRAM,
                Arguments{"--headless", "--scene", "balanced-scaled", "--entities", count,
                          "--frames", "2", "--save", file("snapshot"), "--json", file("json"),
                          "--dump-state", file("state")}));
        }
        for (auto& run : runs) EXPECT_EQ(run->finish().exitCode, 0);
        ASSERT_EQ(files(), (std::vector<std::string>{"json", "snapshot", "state"}));
        const Json loaded = summaryOf({"--load", file("snapshot"), "--frames", "0"});
        EXPECT_TRUE(loaded["entities"] == 3000 || loaded["entities"] == 4000);
        EXPECT_TRUE(parseJson(contentOf(path("json"))).is_object());
        const std::size_t rows = parseTable(contentOf(path("state"))).rows.size();
        EXPECT_TRUE(rows == 3000 || rows == 4000) << rows;
    }
}

/// A name of the greatest length leaves no room for a longer one beside it.
TEST_F(OutputFiles, MayHaveLongNames) {
    const std::string name(255, 'n');
    EXPECT_EQ(runProgram(cradle + Arguments{"--json", file(name)}).exitCode, 0);
    EXPECT_EQ(files(), std::vector<std::string>{name});
}

TEST_F(OutputFiles, ThatDoNotFitAreAnError) {
    for (const std::string& option : outputOptions) {
        if (option == "--save") continue;  // replaces no device
        const ProcessResult result = runProgram(cradle + Arguments{option, "/dev/full"});
        EXPECT_EQ(result.exitCode, 1) << option;
        EXPECT_TRUE(contains(result.err, "/dev/full: cannot be written")) << result.err;
    }
    for (const std::string& option : outputOptions) {
        write("old", "old");
        Process shell("/bin/sh",
                      Arguments{"-c", "ulimit -f 4; exec \"$@\"", "sh", QUADRILLE_PROGRAM,
                                "--headless", "--scene", "pile", "--entities", "300", "--frames",
                                "200", option, file("old")});
        const ProcessResult result = shell.finish();
        // The summary is shorter than the limit.
        EXPECT_EQ(result.exitCode, option == "--json" ? 0 : 1) << option << result.err;
        if (option != "--json") {
            EXPECT_TRUE(contains(result.err, file("old") + ": cannot be written")) << result.err;
            EXPECT_EQ(contentOf(path("old")), "old") << option;
        }
        EXPECT_EQ(files(), std::vector<std::string>{"old"}) << option;
    }
}

#ifdef QUADRILLE_DISK_SPY
/// What takes the place of an old result is on the disk before it does, and so is its name after.
TEST_F(OutputFiles, AreOnTheDiskBeforeTheyReplaceAnything) {
    for (const std::string& option : outputOptions) {
        Process run("/usr/bin/env",
                    Arguments{"LD_PRELOAD=" QUADRILLE_DISK_SPY, "QUADRILLE_SPY=" + file("spy"),
                              "ASAN_OPTIONS=verify_asan_link_order=0", QUADRILLE_PROGRAM} +
                        cradle + Arguments{option, file("result")});
        EXPECT_EQ(run.finish().exitCode, 0);
        EXPECT_EQ(contentOf(path("spy")), "fsync file\nrename\nfsync folder\n") << option;
        fs::remove(path("spy"));
    }
}
#endif

TEST_F(OutputFiles, AreReachedThroughALink) {
    write("target.json", "old");
    fs::create_symlink(path("target.json"), path("link.json"));
    EXPECT_EQ(runProgram(cradle + Arguments{"--json", file("link.json")}).exitCode, 0);
    EXPECT_TRUE(fs::is_symlink(path("link.json")));
    EXPECT_EQ(parseJson(contentOf(path("target.json")))["scene"], "cradle");
}

TEST_F(OutputFiles, AreMadeWhereALinkPoints) {
    fs::create_directory(path("folder"));
    fs::create_symlink("folder/new.json", path("link.json"));
    for (int run = 0; run < 2; ++run) {
        EXPECT_EQ(runProgram(cradle + Arguments{"--json", file("link.json")}).exitCode, 0);
        EXPECT_TRUE(fs::is_symlink(path("link.json")));
        EXPECT_EQ(parseJson(contentOf(path("folder/new.json")))["scene"], "cradle");
    }
}

TEST_F(OutputFiles, ThatAreLinkedInACircleAreRefused) {
    fs::create_symlink("b", path("a"));
    fs::create_symlink("a", path("b"));
    for (const std::string& option : outputOptions) {
        expectRefusal(cradle + Arguments{option, file("a")}, 1, {file("a")});
    }
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
