#pragma once

#include <memory>
#include <string>

#include "app/window/screenshot.hpp"

namespace quadrille::app {

/// A film that is written picture by picture; memory stays flat however long it gets. The file
/// appears whole or not at all, as every output does (system/whole_file.hpp).
class Film {
  public:
    /// By ffmpeg, in the format that the name ends in; without it, or if the name ends in ".y4m",
    /// as Y4M, which is not compressed. Throws Error if the file cannot be written.
    Film(const std::string& file, int width, int height, int picturesPerSecond);
    ~Film();

    /// What writes it, and as what: "Y4M, not compressed".
    const std::string& format() const { return format_; }
    int pictures() const { return pictures_; }

    /// One of another size is cut, or has its missing part black. Throws Error if it cannot be
    /// written.
    void add(const Picture& picture);

    /// Throws Error if anything could not be written.
    void commit();

    struct Writer {
        virtual ~Writer() = default;
        /// Of the film's size.
        virtual void add(const Picture& picture) = 0;
        virtual void commit() = 0;
    };

  private:
    int width_, height_;
    int pictures_ = 0;
    std::string format_;
    std::unique_ptr<Writer> writer_;
};

}  // namespace quadrille::app
