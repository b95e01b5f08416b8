#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "program.hpp"
#include "sanitized.hpp"

namespace quadrille {
namespace {

class Signal : public ProgramTest, public testing::WithParamInterface<int> {};

/// Runs for ever and writes everything there is.
Arguments endlessRun(const Arguments& outputs) {
    return Arguments{"--headless", "--scene", "imbalanced", "--report-every", "0.05"} + outputs;
}

/// So that a run ends by itself, but not at once.
constexpr int fewFrames = sanitized ? 60 : 300;

TEST_P(Signal, EndsTheRunAndWritesWhatWasAskedFor) {
    Process process(QUADRILLE_PROGRAM,
                    endlessRun({"--json", file("run.json"), "--csv", file("frames.csv"),
                                "--dump-state", file("state.csv"), "--dump-events",
                                file("events.csv"), "--save", file("snapshot")}));
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.out(), "ms/frame"); }))
        << process.err();
    EXPECT_FALSE(std::filesystem::exists(path("run.json")));
    process.sendSignal(GetParam());
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exitCode, 128 + GetParam());
    EXPECT_FALSE(result.timedOut);
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(contains(result.out, "summary"));
    EXPECT_TRUE(contains(result.out, "state hash"));
    ASSERT_EQ(files(), (std::vector<std::string>{"events.csv", "frames.csv", "run.json", "snapshot",
                                                 "state.csv"}));

    const Json summary = parseJson(contentOf(path("run.json")));
    ASSERT_GT(summary["frames"], 0);
    EXPECT_EQ(summary["interrupted"], true);
    const Table frames = parseTable(contentOf(path("frames.csv")));
    ASSERT_EQ(frames.rows.size(), summary["frames"]);
    EXPECT_EQ(frames.rows.back().size(), frames.columns.size());
    const Table events = parseTable(contentOf(path("events.csv")));
    EXPECT_EQ(events.rows.size(), summary["collisions"]);
    const Table state = parseTable(contentOf(path("state.csv")));
    ASSERT_EQ(state.rows.size(), summary["entities"]);
    EXPECT_EQ(state.rows.back().size(), 5u);
    const Json resumed = summaryOf({"--load", file("snapshot"), "--frames", "0"});
    EXPECT_EQ(resumed["state_hash"], summary["state_hash"]);
}

TEST_P(Signal, IsHeededWhileDataGoesToStdout) {
    Process process(QUADRILLE_PROGRAM, endlessRun({"--json", "-"}));
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.err(), "ms/frame"); }));
    process.sendSignal(GetParam());
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exitCode, 128 + GetParam());
    EXPECT_TRUE(contains(result.err, "summary"));
    const Json summary = parseJson(result.out);
    ASSERT_TRUE(summary.is_object()) << result.out;
    EXPECT_GT(summary["frames"], 0);
    EXPECT_EQ(summary["interrupted"], true);
}

/// As nohup has it for SIGHUP, and a shell without jobs for the SIGINT of what runs behind it.
TEST_P(Signal, StaysIgnoredIfItWas) {
    const std::string number = std::to_string(GetParam());
    Process process(
        "/bin/sh",
        Arguments{"-c", "trap '' " + number + "; exec \"$@\"", "sh", QUADRILLE_PROGRAM} +
            endlessRun({"--json", file("run.json"), "--frames", std::to_string(fewFrames)}));
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.out(), "ms/frame"); }));
    process.sendSignal(GetParam());
    EXPECT_EQ(process.finish().exitCode, 0);
    const Json summary = parseJson(contentOf(path("run.json")));
    EXPECT_EQ(summary["frames"], fewFrames);
    EXPECT_EQ(summary["interrupted"], false);
}

INSTANTIATE_TEST_SUITE_P(Run, Signal, testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& test) {
                             return test.param == SIGINT    ? "interrupt"
                                    : test.param == SIGTERM ? "terminate"
                                                            : "hangup";
                         });

class SignalInAFrame : public ProgramTest {
  protected:
    static constexpr int lanes = 40;

    /// In each lane a heavy box drives a light one against a wall, which takes 993,458 collisions
    /// in all (Galperin 2003), nearly all of them in the frame in which the heavy one turns round.
    std::string crushes() const {
        std::string boxes = "x,y,vx,vy,w,h,mass\n";
        for (int lane = 0; lane < lanes; ++lane) {
            const std::string y = std::to_string(4 * lane - 2 * lanes);
            boxes += "-40," + y + ",0,0,2,2,1\n-30," + y + ",-60,0,2,2,1e11\n";
        }
        write("boxes.csv", boxes);
        return write("crushes.toml",
                     "format = 1\nworld = { size = [200, 200] }\nstep = { law = 'continuous' }\n"
                     "[[body]]\nposition = [-50, 0]\nsize = [2, 180]\nstatic = true\n"
                     "[[instance]]\nfile = 'boxes.csv'\n");
    }
};

TEST_F(SignalInAFrame, LeavesItWithTheOutputsOfTheFrameBefore) {
    const std::string scene = crushes();
    Process process(
        QUADRILLE_PROGRAM,
        {"--headless", "--scene", scene, "--frames", "1000", "--report-every", "1e-9", "--json",
         file("run.json"), "--csv", file("frames.csv"), "--dump-state", file("state.csv"),
         "--dump-events", file("events.csv"), "--save", file("snapshot"), "--save-every", "3"});
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.out(), "frames 10 "); }))
        << process.err();
    std::this_thread::sleep_for(std::chrono::seconds(1));
    process.sendSignal(SIGTERM);
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exitCode, 128 + SIGTERM);
    const Json summary = parseJson(contentOf(path("run.json")));
    EXPECT_EQ(summary["interrupted"], true);
    // None of the frame that would have taken minutes.
    EXPECT_LT(summary["collisions"], lanes * 10'000);

    const Json undisturbed = summaryOf({"--scene", scene, "--frames", summary["frames"].dump()});
    EXPECT_EQ(summary["state_hash"], undisturbed["state_hash"]);
    EXPECT_EQ(parseTable(contentOf(path("frames.csv"))).rows.size(), summary["frames"]);
    EXPECT_EQ(parseTable(contentOf(path("events.csv"))).rows.size(), summary["collisions"]);
    EXPECT_EQ(parseTable(contentOf(path("state.csv"))).rows.size(), 2u * lanes);
    const Json resumed = summaryOf({"--load", file("snapshot"), "--frames", "0"});
    EXPECT_EQ(resumed["state_hash"], summary["state_hash"]);
    EXPECT_EQ(resumed["steps_done"], summary["steps_done"]);
}

/// What a terminal shows of a frame that nothing interrupts.
TEST_F(SignalInAFrame, FindsItShownOnATerminal) {
    Process process(QUADRILLE_PROGRAM, {"--headless", "--scene", crushes(), "--frames", "1000"},
                    Process::Stderr::Terminal);
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.err(), " in the next"); }));
    const std::regex line(R"(frame \d+ of 1000, \d+ %, [^,]+ left, and 1 s in the next)");
    EXPECT_TRUE(std::regex_search(process.err(), line)) << process.err();
    EXPECT_FALSE(contains(process.err(), ", 0 s left")) << process.err();
    process.sendSignal(SIGTERM);
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exitCode, 128 + SIGTERM);
    EXPECT_TRUE(result.err.ends_with("\r\x1b[K")) << result.err;
}

class DeadlySignal : public ProgramTest, public testing::WithParamInterface<int> {};

/// Everything there is grows in the folder, and nothing of it stays; what was there does.
TEST_P(DeadlySignal, LeavesNothingUnfinished) {
    write("run.json", "old");
    Process process(QUADRILLE_PROGRAM,
                    endlessRun({"--json", file("run.json"), "--csv", file("frames.csv"),
                                "--dump-state", file("state.csv"), "--dump-events",
                                file("events.csv"), "--save", file("snapshot")}));
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.out(), "ms/frame"); }));
    EXPECT_EQ(files().size(), 5u);
    process.sendSignal(GetParam());
    EXPECT_EQ(process.finish().exitCode, 128 + GetParam());
    EXPECT_EQ(files(), std::vector<std::string>{"run.json"});
    EXPECT_EQ(contentOf(path("run.json")), "old");
}

INSTANTIATE_TEST_SUITE_P(Run, DeadlySignal,
                         testing::Values(SIGPIPE, SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM, SIGXCPU,
                                         SIGABRT),
                         testing::PrintToStringParamName());

class LongRun : public ProgramTest {};

/// Results grow under another name, and the old ones stay until the new ones are complete.
TEST_F(LongRun, KeepsOldResultsUntilItsEnd) {
    write("frames.csv", "old");
    Process process(QUADRILLE_PROGRAM, endlessRun({"--csv", file("frames.csv")}));
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.out(), "ms/frame"); }));
    EXPECT_EQ(contentOf(path("frames.csv")), "old");
    process.sendSignal(SIGINT);
    EXPECT_EQ(process.finish().exitCode, 128 + SIGINT);
    EXPECT_TRUE(contains(contentOf(path("frames.csv")), "frame,"));
    EXPECT_EQ(files(), std::vector<std::string>{"frames.csv"});
}

/// A reader that stops reading holds the run up in the middle of a frame, where the first signal
/// cannot end it.
TEST_F(LongRun, EndsAtOnceAtTheSecondSignal) {
    ASSERT_EQ(mkfifo(file("pipe").c_str(), 0600), 0);
    const int reader = open(file("pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    ASSERT_GE(reader, 0);
    Process process(QUADRILLE_PROGRAM,
                    {"--headless", "--scene", "pile", "--entities", "20", "--csv", file("pipe"),
                     "--json", file("json"), "--dump-state", file("state")});
    ASSERT_TRUE(process.waitUntil([&] {
        int bytes = 0;
        return ioctl(reader, FIONREAD, &bytes) == 0 && bytes >= 1 << 16;
    }));
    EXPECT_EQ(files().size(), 3u);
    process.sendSignal(SIGINT);
    process.sendSignal(SIGTERM);
    EXPECT_EQ(process.finish().exitCode, 128 + SIGTERM);
    EXPECT_EQ(files(), std::vector<std::string>{"pipe"});
    close(reader);
}

TEST_F(LongRun, EndsWhenNobodyReadsItsWords) {
    Process process(QUADRILLE_PROGRAM,
                    endlessRun({"--json", file("json"), "--csv", file("frames.csv")}));
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.out(), "ms/frame"); }));
    process.closeOut();
    EXPECT_EQ(process.finish().exitCode, 128 + SIGPIPE);
    EXPECT_TRUE(files().empty());
}

/// Where that signal is ignored, the words that are lost are a failure, and the results are whole.
TEST_F(LongRun, SaysThatItsWordsWereLost) {
    Process process(
        "/bin/sh", Arguments{"-c", "trap '' PIPE; exec \"$@\"", "sh", QUADRILLE_PROGRAM} +
                       endlessRun({"--json", file("json"), "--frames", std::to_string(fewFrames)}));
    process.closeOut();
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_TRUE(contains(result.err, "stdout: cannot be written")) << result.err;
    EXPECT_EQ(parseJson(contentOf(path("json")))["frames"], fewFrames);
}

/// Nothing can be done about this one; what it leaves says what it is.
TEST_F(LongRun, LeavesNoMoreThanATemporaryFileWhenItIsKilled) {
    write("frames.csv", "old");
    Process process(QUADRILLE_PROGRAM, endlessRun({"--csv", file("frames.csv")}));
    ASSERT_TRUE(process.waitUntil([&] { return contains(process.out(), "ms/frame"); }));
    process.sendSignal(SIGKILL);
    EXPECT_EQ(process.finish().exitCode, 128 + SIGKILL);
    EXPECT_EQ(contentOf(path("frames.csv")), "old");
    const std::vector<std::string> left = files();
    ASSERT_EQ(left.size(), 2u);
    EXPECT_TRUE(left[1].starts_with("frames.csv.") && left[1].ends_with(".part")) << left[1];
}

}  // namespace
}  // namespace quadrille
