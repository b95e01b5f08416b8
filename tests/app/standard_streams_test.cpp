#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "program.hpp"

namespace quadrille {
namespace {

class StandardStreams : public ProgramTest {
  protected:
    /// Runs the program with the redirections of a shell.
    static ProcessResult redirected(const std::string& redirections, const Arguments& arguments) {
        Process shell(
            "/bin/sh",
            Arguments{"-c", "exec \"$@\" " + redirections, "sh", QUADRILLE_PROGRAM} + arguments);
        return shell.finish();
    }
};

/// The words of the run must not be written over the first file that is opened.
TEST_F(StandardStreams, ThatAreClosedAreNotTakenForAFile) {
    for (const std::string closed :
         {"<&-", ">&-", "2>&-", "<&- >&-", "<&- 2>&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
        SCOPED_TRACE(closed);
        const ProcessResult result = redirected(
            closed, {"--headless",   "--scene",    "pile",           "--entities",  "100",
                     "--frames",     "50",         "--report-every", "0.001",       "--law",
                     "continuous",   "--resolver", "cuda",           "--json",      file("json"),
                     "--csv",        file("csv"),  "--dump-state",   file("state"), "--dump-events",
                     file("events"), "--save",     file("snapshot")});
        EXPECT_EQ(result.exitCode, 0) << result.err;
        const Json summary = parseJson(contentOf(path("json")));
        ASSERT_TRUE(summary.is_object());
        const Table frames = parseTable(contentOf(path("csv")));
        EXPECT_EQ(frames.rows.size(), 50u);
        for (const auto& row : frames.rows) EXPECT_EQ(row.size(), frames.columns.size());
        const Table state = parseTable(contentOf(path("state")));
        EXPECT_EQ(state.rows.size(), summary["entities"]);
        for (const auto& row : state.rows) EXPECT_EQ(row.size(), 5u);
        const Table events = parseTable(contentOf(path("events")));
        EXPECT_EQ(events.rows.size(), summary["collisions"]);
        for (const auto& row : events.rows) EXPECT_EQ(row.size(), events.columns.size());
        EXPECT_EQ(summaryOf({"--load", file("snapshot"), "--frames", "0"})["state_hash"],
                  summary["state_hash"]);
    }
}

/// Everything that is on stdout because somebody asked for it.
const std::vector<Arguments> questions = {
    {"--help"},
    {"--version"},
    {"--list"},
    {"--explain", "--headless", "--scene", "cradle"},
    {"--headless", "--scene", "cradle", "--frames", "1", "--json", "-"},
    {"--headless", "--scene", "cradle", "--frames", "1", "--csv", "-"},
    {"--headless", "--scene", "cradle", "--frames", "1", "--dump-state", "-"},
    {"--headless", "--scene", "cradle", "--frames", "1", "--dump-events", "-"}};

TEST_F(StandardStreams, ThatAreClosedGiveNoAnswer) {
    for (const Arguments& question : questions) {
        const ProcessResult result = redirected(">&-", question);
        EXPECT_EQ(result.exitCode, 1) << question.front();
        EXPECT_TRUE(contains(result.err, "stdout: ")) << question.front() << result.err;
    }
}

TEST_F(StandardStreams, ThatAreFullAreAnError) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has none";
    std::vector<Arguments> all = questions;
    all.push_back({"--headless", "--scene", "cradle", "--frames", "1"});
    for (const Arguments& question : all) {
        const ProcessResult result = redirected("> /dev/full", question);
        EXPECT_EQ(result.exitCode, 1) << question.front();
        EXPECT_TRUE(contains(result.err, "stdout: ")) << question.front() << result.err;
    }
}

/// The results do not depend on who reads the summary.
TEST_F(StandardStreams, ThatAreFullTakeNoFileAway) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has none";
    EXPECT_EQ(redirected("> /dev/full", {"--headless", "--scene", "cradle", "--frames", "5",
                                         "--json", file("json"), "--save", file("snapshot")})
                  .exitCode,
              1);
    EXPECT_EQ(parseJson(contentOf(path("json")))["frames"], 5);
    EXPECT_EQ(files(), (std::vector<std::string>{"json", "snapshot"}));
}

TEST_F(StandardStreams, OfMessagesMayBeFull) {
    EXPECT_EQ(redirected("2> /dev/full", {"--frobnicate"}).exitCode, 2);
    EXPECT_EQ(redirected("2>&-", {"--frobnicate"}).exitCode, 2);
}

}  // namespace
}  // namespace quadrille
