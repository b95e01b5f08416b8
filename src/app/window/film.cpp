#include "app/window/film.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <vector>

#include <quadrille/error.hpp>

#include "app/video_format.hpp"
#include "app/window/y4m.hpp"
#include "system/program_pipe.hpp"
#include "system/whole_file.hpp"

namespace quadrille::app {

namespace {

class Y4mWriter : public Film::Writer {
  public:
    Y4mWriter(const std::string& file, int width, int height, int picturesPerSecond) : file_(file) {
        file_.stream() << y4mHead(width, height, picturesPerSecond);
    }
    void add(const Picture& picture) override {
        addY4mPicture(file_.stream(), picture);
        // A film that is too large for the disk should not go on for hours.
        if (!file_.stream()) commit();
    }
    void commit() override { file_.commit(); }

  private:
    WholeFile file_;
};

class FfmpegWriter : public Film::Writer {
  public:
    FfmpegWriter(const std::filesystem::path& program, const std::string& file,
                 const VideoFormat& format, int width, int height, int picturesPerSecond)
        : name_(file),
          file_(file),
          ffmpeg_(program,
                  arguments(format, file_.temporary().string(), width, height, picturesPerSecond)) {
    }
    void add(const Picture& picture) override {
        const char* const data = reinterpret_cast<const char*>(picture.rgb.data());
        if (ffmpeg_.write(data, picture.rgb.size())) return;
        finish();
        throw Error(name_ + ": ffmpeg ended before the film");
    }
    void commit() override {
        finish();
        file_.commit();
    }

  private:
    static std::vector<std::string> arguments(const VideoFormat& format, const std::string& target,
                                              int width, int height, int picturesPerSecond) {
        const std::string size = std::to_string(width) + "x" + std::to_string(height);
        const std::string rate = std::to_string(picturesPerSecond);
        std::vector<std::string> all = {"-hide_banner", "-loglevel", "error", "-y",    "-f",
                                        "rawvideo",     "-pix_fmt",  "rgb24", "-s",    size,
                                        "-r",           rate,        "-i",    "pipe:0"};
        for (const char* argument : format.arguments) all.emplace_back(argument);
        all.insert(all.end(), {"-f", format.container, target});
        return all;
    }

    void finish() {
        const int code = ffmpeg_.finish();
        if (code != 0) {
            throw Error(name_ + ": ffmpeg could not write it (exit code " + std::to_string(code) +
                        ")");
        }
    }

    std::string name_;
    WholeFile file_;
    ProgramPipe ffmpeg_;
};

/// The picture in a film of this size.
Picture fitted(const Picture& picture, int width, int height) {
    Picture result{width, height, {}};
    result.rgb.resize(3 * std::size_t(width) * std::size_t(height));
    const int columns = std::min(width, picture.width);
    for (int y = 0; y < std::min(height, picture.height); ++y) {
        std::copy_n(picture.rgb.begin() + 3 * std::ptrdiff_t(y) * picture.width, 3 * columns,
                    result.rgb.begin() + 3 * std::ptrdiff_t(y) * width);
    }
    return result;
}

}  // namespace

Film::Film(const std::string& file, int width, int height, int picturesPerSecond)
    : width_(width), height_(height) {
    const VideoFormat* const format = findVideoFormat(file);
    const auto ffmpeg = format != nullptr ? findProgram("ffmpeg") : std::filesystem::path();
    if (!ffmpeg.empty()) {
        format_ = std::string(format->name) + ", by " + ffmpeg.string();
        writer_ =
            std::make_unique<FfmpegWriter>(ffmpeg, file, *format, width, height, picturesPerSecond);
    } else {
        format_ = format == nullptr ? "Y4M, not compressed"
                                    : "Y4M, not compressed, since there is no ffmpeg";
        writer_ = std::make_unique<Y4mWriter>(file, width, height, picturesPerSecond);
    }
}

Film::~Film() = default;

void Film::add(const Picture& picture) {
    if (picture.width == width_ && picture.height == height_) {
        writer_->add(picture);
    } else {
        writer_->add(fitted(picture, width_, height_));
    }
    ++pictures_;
}

void Film::commit() { writer_->commit(); }

}  // namespace quadrille::app
