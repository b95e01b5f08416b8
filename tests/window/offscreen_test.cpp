#include <csignal>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/resource.h>

#include "sanitized.hpp"
#include "scenes.hpp"
#include "window_run.hpp"

namespace quadrille {
namespace {

class Offscreen : public WindowTest {
  protected:
    /// Without a display, and without a driver that the environment chooses.
    void startOffscreen(const Arguments& arguments) {
        program_ = std::make_unique<Process>(
            "/usr/bin/env",
            Arguments{"-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", "-u", "SDL_VIDEODRIVER",
                      "LIBGL_ALWAYS_SOFTWARE=1", QUADRILLE_PROGRAM, "--offscreen"} +
                arguments);
    }

    /// The most memory that a program took which this test has waited for, MB.
    static double mostMemory() {
        rusage usage{};
        getrusage(RUSAGE_CHILDREN, &usage);
        return double(usage.ru_maxrss) / 1024;
    }
};

TEST_F(Offscreen, DrawsThePicturesOfAWindow) {
    const Arguments run = {"--scene",
                           write("still.toml", stillScene),
                           "--frames",
                           "12",
                           "--speed",
                           "max",
                           "--hide-panels",
                           "--json",
                           "-"};
    start(run + Arguments{"--screenshot", file("window.png")});
    ProcessResult result = program_->finish();
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const Json inWindow = parseJson(result.out);
    startOffscreen(run + Arguments{"--screenshot", file("offscreen.png")});
    result = program_->finish();
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const Json offscreen = parseJson(result.out);
    EXPECT_EQ(offscreen["state_hash"], inWindow["state_hash"]);
    EXPECT_EQ(offscreen["window"]["pictures"], inWindow["window"]["pictures"]);
    const Image expected = readPng(path("window.png")), image = readPng(path("offscreen.png"));
    ASSERT_EQ(expected.width, width);
    ASSERT_EQ(image.width, width);
    EXPECT_EQ(image.pixels, expected.pixels);
    // It shows something at all.
    EXPECT_FALSE(near(image.at(width / 2 + 12 * 6, height / 2), background, 30));
}

TEST_F(Offscreen, TakesAStepInEveryPictureUnlessAskedForASpeed) {
    startOffscreen({"--scene", "cradle", "--frames", "30", "--size", "320,200", "--json", "-",
                    "--screenshot", file("a.png")});
    const ProcessResult result = program_->finish();
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(parseJson(result.out)["window"]["pictures"], 30);
    EXPECT_EQ(readPng(path("a.png")).width, 320);
    EXPECT_EQ(readPng(path("a.png")).height, 200);
}

/// The panels leave no room for two views and plots.
TEST_F(Offscreen, DrawsAComparisonInAWindowThatIsTooNarrow) {
    for (const char* size : {"300,300", "250,200", "64,64"}) {
        SCOPED_TRACE(size);
        startOffscreen({"--scene", "cradle", "--compare", "impulse,continuous", "--frames", "4",
                        "--size", size, "--screenshot", file("a.png")});
        const ProcessResult result = program_->finish();
        ASSERT_EQ(result.exitCode, 0) << result.err;
        EXPECT_GT(readPng(path("a.png")).width, 0);
    }
}

/// A driver that is never told that a picture is done kept some 800 kB of each.
TEST_F(Offscreen, KeepsNothingOfThePicturesBefore) {
    if (sanitized) GTEST_SKIP() << "the sanitizer keeps memory that was freed";
    const auto memoryOf = [&](const std::string& frames) {
        startOffscreen({"--scene", "cradle", "--frames", frames});
        const ProcessResult result = program_->finish();
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return mostMemory();
    };
    const double few = memoryOf("20");
    EXPECT_LT(memoryOf("320"), few + 60);
}

TEST_F(Offscreen, ASignalEndsIt) {
    startOffscreen({"--scene", "cradle", "--csv", "-", "--json", file("run.json")});
    ASSERT_TRUE(program_->waitUntil([&] { return contains(program_->out(), "\n3,"); }));
    program_->sendSignal(SIGTERM);
    const ProcessResult result = program_->finish();
    EXPECT_EQ(result.exitCode, 128 + SIGTERM) << result.err;
    EXPECT_EQ(parseJson(contentOf(path("run.json")))["interrupted"], true);
}

}  // namespace
}  // namespace quadrille
