#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/stat.h>
#include <vector>

#include "sanitized.hpp"
#include "scenes.hpp"
#include "window_run.hpp"

namespace quadrille {
namespace {

namespace fs = std::filesystem;

/// A film in Y4M.
struct Y4m {
    std::string head;
    int width = 0, height = 0;
    std::vector<std::string> pictures;  // planes Y, Cb, Cr
};

Y4m readY4m(const fs::path& file, int width, int height) {
    const std::string content = contentOf(file);
    Y4m film{content.substr(0, content.find('\n')), width, height, {}};
    const std::string mark = "FRAME\n";
    const std::size_t bytes = 3 * std::size_t(width) * std::size_t(height);
    for (std::size_t i = film.head.size() + 1; i < content.size(); i += mark.size() + bytes) {
        if (content.compare(i, mark.size(), mark) != 0) return {};
        film.pictures.push_back(content.substr(i + mark.size(), bytes));
    }
    return film;
}

class Video : public WindowTest {
  protected:
    /// Without a display; `folders` is the PATH.
    ProcessResult film(const Arguments& arguments, const std::string& folders) {
        return Process("/usr/bin/env",
                       Arguments{"-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", "-u", "SDL_VIDEODRIVER",
                                 "LIBGL_ALWAYS_SOFTWARE=1", "PATH=" + folders, QUADRILLE_PROGRAM,
                                 "--offscreen", "--hide-panels", "--size", "320,200"} +
                           arguments)
            .finish();
    }

    /// A program that is called ffmpeg, in a folder of its own; returns the folder.
    std::string pretendFfmpeg(const std::string& script) {
        fs::create_directory(path("programs"));
        const std::string program = write("programs/ffmpeg", "#!/bin/sh\n" + script);
        chmod(program.c_str(), 0755);
        return file("programs");
    }

    void SetUp() override {}
};

TEST_F(Video, WithoutFfmpegItIsY4mAndSaysSo) {
    const std::string scene = write("still.toml", stillScene);
    const ProcessResult result =
        film({"--scene", scene, "--frames", "20", "--video", file("a.mp4")}, "/none");
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(contains(result.err, "a.mp4: 320 x 200 at 60 pictures per second, Y4M"));
    EXPECT_TRUE(contains(result.err, "no ffmpeg")) << result.err;
    const Y4m film = readY4m(path("a.mp4"), 320, 200);
    EXPECT_EQ(film.head, "YUV4MPEG2 W320 H200 F60:1 Ip A1:1 C444");
    // Step 0, and a step of 1/64 s in most of the pictures of 1/60 s.
    EXPECT_NEAR(double(film.pictures.size()), 20 * 60 / 64.0 + 1, 2);
    EXPECT_TRUE(contains(result.err, std::to_string(film.pictures.size()) + " pictures"))
        << result.err;
    // The ground's luma, and a mover that is elsewhere at the end.
    EXPECT_NEAR(double(static_cast<unsigned char>(film.pictures.front()[2])), 16 + 16 * 0.86, 2);
    EXPECT_NE(film.pictures.front(), film.pictures.back());
    EXPECT_EQ(files(), (std::vector<std::string>{"a.mp4", "still.toml"}));
}

TEST_F(Video, FrameRateAndSpeedAreChosen) {
    const std::string scene = write("still.toml", stillScene);
    const auto pictures = [&](const Arguments& more) {
        const ProcessResult result =
            film(Arguments{"--scene", scene, "--frames", "32", "--video", file("a.y4m")} + more,
                 "/none");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_FALSE(contains(result.err, "no ffmpeg")) << result.err;
        return double(readY4m(path("a.y4m"), 320, 200).pictures.size());
    };
    // Half a second of the simulation.
    EXPECT_NEAR(pictures({"--frame-rate", "24"}), 13, 1);
    EXPECT_NEAR(pictures({"--frame-rate", "24", "--speed", "0.25"}), 49, 1);
    EXPECT_NEAR(pictures({"--frame-rate", "24", "--speed", "4"}), 4, 1);
    EXPECT_EQ(pictures({"--frame-rate", "24", "--speed", "max"}), 32);
}

/// What ffmpeg is given, and that the file has its name only at the end.
TEST_F(Video, GivesFfmpegEveryPicture) {
    const std::string folders = pretendFfmpeg(
        "for last; do :; done\n"
        "echo \"$@\" >\"" +
        file("arguments") +
        "\"\n"
        "test ! -e \"" +
        file("a.mp4") +
        "\" || exit 9\n"
        "/bin/cat >\"$last\"\n");
    const ProcessResult result =
        film({"--scene", "cradle", "--frames", "5", "--video", file("a.mp4")}, folders);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(contains(result.err, "H.264 in MP4, by " + folders + "/ffmpeg")) << result.err;
    const std::string arguments = contentOf(path("arguments"));
    EXPECT_TRUE(contains(arguments, "-f rawvideo -pix_fmt rgb24 -s 320x200 -r 60 -i pipe:0"));
    EXPECT_TRUE(contains(arguments, "-f mp4 ")) << arguments;
    EXPECT_TRUE(contains(arguments, ".part")) << arguments;
    EXPECT_EQ(fs::file_size(path("a.mp4")), 6u * 3 * 320 * 200);
    EXPECT_EQ(files(), (std::vector<std::string>{"a.mp4", "arguments", "programs"}));
}

TEST_F(Video, AnFfmpegThatFailsIsAnErrorAndLeavesTheOldFile) {
    write("a.mp4", "an old film");
    for (const char* script : {"/bin/cat >/dev/null; exit 3\n", "exit 3\n"}) {
        const std::string folders = pretendFfmpeg(script);
        const ProcessResult result =
            film({"--scene", "cradle", "--frames", "40", "--video", file("a.mp4")}, folders);
        EXPECT_EQ(result.exitCode, 1);
        EXPECT_TRUE(contains(result.err, "a.mp4: ffmpeg could not write it (exit code 3)"))
            << result.err;
        fs::remove_all(path("programs"));
        EXPECT_EQ(contentOf(path("a.mp4")), "an old film");
        EXPECT_EQ(files(), std::vector<std::string>{"a.mp4"});
    }
}

TEST_F(Video, WhatElseTheRunIsAskedForOutlivesAFilmThatFails) {
    const std::string folders = pretendFfmpeg("/bin/cat >/dev/null; exit 3\n");
    const ProcessResult result = film({"--scene", "cradle", "--frames", "20", "--video",
                                       file("a.mp4"), "--save", file("a.snapshot")},
                                      folders);
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_TRUE(contains(result.err, "ffmpeg could not write it")) << result.err;
    EXPECT_EQ(files(), (std::vector<std::string>{"a.snapshot", "programs"}));
}

TEST_F(Video, OfARunThatStandsStillIsNone) {
    write("a.y4m", "an old film");
    expectRefusal({"--offscreen", "--paused", "--frames", "3", "--video", file("a.y4m")}, 2,
                  {"--video", "--paused"});
    EXPECT_EQ(contentOf(path("a.y4m")), "an old film");
}

TEST_F(Video, SaysHowFarItIs) {
    const ProcessResult result = film({"--scene", "cradle", "--frames", "300", "--video",
                                       file("a.y4m"), "--report-every", "0.05"},
                                      "/none");
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(contains(result.err, " pictures, frame ")) << result.err;
    EXPECT_TRUE(contains(result.err, " of 300, ")) << result.err;
    EXPECT_TRUE(contains(result.err, " s left")) << result.err;
}

TEST_F(Video, KeepsNothingOfThePicturesBefore) {
    if (sanitized) GTEST_SKIP() << "the sanitizer keeps memory that was freed";
    const auto peakOf = [&](const std::string& frames) {
        const ProcessResult result =
            film({"--scene", "cradle", "--frames", frames, "--video", file("a.y4m")}, "/none");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result.peakBytes;
    };
    const double few = peakOf("20");
    EXPECT_GT(few, 0);
    EXPECT_LT(peakOf("320"), few + 20e6);
}

TEST_F(Video, HasTheBitsOfARunWithoutOne) {
    const ProcessResult result = film({"--scene", "imbalanced", "--frames", "60", "--speed", "2",
                                       "--json", "-", "--video", file("a.y4m")},
                                      "/none");
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(parseJson(result.out)["state_hash"],
              summaryOf({"--scene", "imbalanced", "--frames", "60"})["state_hash"]);
}

TEST_F(Video, WhatCannotBeWrittenIsRefused) {
    expectRefusal({"--video", "a.txt"}, 2, {"--video", "a.txt", ".mp4", ".y4m"});
    expectRefusal({"--headless", "--video", "a.mp4"}, 2, {"--video", "--headless"});
    expectRefusal({"--frame-rate", "30"}, 2, {"--frame-rate", "--video"});
    expectRefusal({"--video", "a.mp4", "--frame-rate", "0"}, 2, {"--frame-rate"});
    expectRefusal({"--video", "a.y4m", "--screenshot", "a.y4m"}, 2, {"--screenshot", "--video"});
    expectRefusal({"--offscreen", "--scene", "cradle", "--video", file("none/a.y4m")}, 1,
                  {"a.y4m"});
}

}  // namespace
}  // namespace quadrille
