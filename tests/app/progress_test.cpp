// What a terminal shows of a run while it lasts, and that nothing else is shown it.
#include "app/progress.hpp"

#include <csignal>
#include <cstdint>
#include <gtest/gtest.h>
#include <regex>
#include <string>
#include <vector>

#include "program.hpp"

namespace quadrille {
namespace {

using app::ProgressLine;

TEST(Progress, IsTheShareThatIsDoneAndTheTimeLeft) {
    const ProgressLine frames(600, std::nullopt);
    EXPECT_EQ(frames.text(120, 50), "frame 120 of 600, 20 %, 3 min 20 s left");
    EXPECT_EQ(frames.text(599, 50), "frame 599 of 600, 99 %, 1 s left");
    EXPECT_EQ(frames.text(600, 50), "frame 600 of 600, 100 %, 0 s left");
    EXPECT_EQ(ProgressLine(100, std::nullopt).text(29, 58),
              "frame 29 of 100, 29 %, 2 min 22 s left");
    const ProgressLine duration(std::nullopt, 40);
    EXPECT_EQ(duration.text(7, 10), "frame 7, 25 %, 30 s left");
    EXPECT_EQ(duration.text(0, 0), "frame 0, 0 %, 40 s left");
    EXPECT_EQ(duration.text(7, 45), "frame 7, 100 %, 0 s left");  // in a long frame
}

TEST(Progress, IsThatOfWhatEndsTheRunFirst) {
    const ProgressLine line(600, 40);
    EXPECT_EQ(line.text(300, 10), "frame 300 of 600, 50 %, 10 s left");
    EXPECT_EQ(line.text(60, 10), "frame 60 of 600, 25 %, 30 s left");
}

TEST(Progress, HasTwoUnitsOfTime) {
    const auto left = [](double seconds) { return ProgressLine(2, std::nullopt).text(1, seconds); };
    const std::string start = "frame 1 of 2, 50 %, ";
    EXPECT_EQ(left(59), start + "59 s left");
    EXPECT_EQ(left(59.5), start + "1 min 0 s left");
    EXPECT_EQ(left(3599), start + "59 min 59 s left");
    EXPECT_EQ(left(3600), start + "1 h 0 min left");
    EXPECT_EQ(left(86400 - 60), start + "23 h 59 min left");
    EXPECT_EQ(left(86400 + 3600), start + "1 d 1 h left");
}

TEST(Progress, SaysNothingOfWhatIsNotKnown) {
    EXPECT_EQ(ProgressLine(std::nullopt, std::nullopt).text(7, 10), "frame 7");
    EXPECT_EQ(ProgressLine(600, std::nullopt).text(0, 10), "frame 0 of 600, 0 %");
    EXPECT_EQ(ProgressLine(std::uint64_t(-1), std::nullopt).text(1, 10),
              "frame 1 of 18446744073709551615, 0 %");
}

/// What a terminal was shown, a line for each time.
std::vector<std::string> linesOf(const std::string& shown) {
    static const std::string start = "\r\x1b[K";
    std::vector<std::string> lines;
    for (std::size_t at = shown.find(start); at != std::string::npos;) {
        const std::size_t next = shown.find(start, at + start.size());
        lines.push_back(shown.substr(at + start.size(), next - at - start.size()));
        at = next;
    }
    return lines;
}

std::vector<std::string> shownOf(const Arguments& arguments) {
    Process process(QUADRILLE_PROGRAM, Arguments{"--headless", "--scene", "cradle"} + arguments,
                    Process::Stderr::Terminal);
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exitCode, 0);
    return linesOf(result.err);
}

TEST(Progress, OfADurationEndsWithIt) {
    std::vector<std::string> lines = shownOf({"--duration", "2.5"});
    std::erase(lines, "");
    ASSERT_GE(lines.size(), 2u);
    const std::regex form(R"(frame \d+, (\d+) %, ([0-3]) s left)");
    int lastPercent = 0, lastLeft = 3;
    for (const std::string& line : lines) {
        std::smatch match;
        ASSERT_TRUE(std::regex_match(line, match, form)) << line;
        const int percent = std::stoi(match[1]), left = std::stoi(match[2]);
        EXPECT_GT(percent, lastPercent) << line;
        EXPECT_LE(left, lastLeft) << line;
        // The time left is rounded up.
        EXPECT_NEAR(2.5 * percent / 100 + left, 3, 0.55) << line;
        lastPercent = percent;
        lastLeft = left;
    }
}

TEST(Progress, OfFramesGrowsUntilItIsWiped) {
    constexpr std::uint64_t frames = 1'000'000'000'000;
    Process process(QUADRILLE_PROGRAM,
                    {"--headless", "--scene", "cradle", "--frames", std::to_string(frames)},
                    Process::Stderr::Terminal);
    ASSERT_TRUE(process.waitUntil([&] { return linesOf(process.err()).size() > 3; }));
    process.sendSignal(SIGINT);
    const ProcessResult result = process.finish();
    EXPECT_EQ(result.exitCode, 128 + SIGINT);
    const std::vector<std::string> lines = linesOf(result.err);
    EXPECT_EQ(lines.back(), "");
    const std::regex form(R"(frame (\d+) of 1000000000000, 0 %(, \d+ d \d+ h left)?)");
    std::uint64_t last = 0;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
        std::smatch match;
        ASSERT_TRUE(std::regex_match(lines[i], match, form)) << lines[i];
        EXPECT_GT(std::stoull(match[1]), last);
        last = std::stoull(match[1]);
    }
    EXPECT_TRUE(contains(result.out, "summary"));
}

TEST(Progress, IsForTerminalsAndRunsWithAnEnd) {
    Process endless(QUADRILLE_PROGRAM, {"--headless", "--scene", "cradle", "--report-every", "0.5"},
                    Process::Stderr::Terminal);
    ASSERT_TRUE(endless.waitUntil([&] { return contains(endless.out(), "ms/frame"); }));
    EXPECT_FALSE(contains(endless.err(), "frame"));
    const ProcessResult piped =
        runProgram({"--headless", "--scene", "cradle", "--duration", "0.5"});
    EXPECT_EQ(piped.err, "");
    EXPECT_FALSE(contains(piped.out, " left"));
    EXPECT_FALSE(contains(piped.out, "\r"));
}

}  // namespace
}  // namespace quadrille
