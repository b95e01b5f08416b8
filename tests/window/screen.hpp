#pragma once

#include <X11/Xlib.h>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "process.hpp"

namespace quadrille {

struct Rgb {
    int r = 0, g = 0, b = 0;

    friend bool operator==(const Rgb&, const Rgb&) = default;
    friend std::ostream& operator<<(std::ostream& out, const Rgb& c) {
        return out << '(' << c.r << ", " << c.g << ", " << c.b << ')';
    }
};

/// Whether no channel differs by more than a rounding of blending.
bool near(const Rgb& a, const Rgb& b, int tolerance = 3);

/// What a screen or a file shows.
struct Image {
    int width = 0, height = 0;
    std::vector<Rgb> pixels;

    const Rgb& at(int x, int y) const {
        return pixels.at(std::size_t(y) * std::size_t(width) + std::size_t(x));
    }
};

/// Reads a PNG file; an empty image if it is none.
Image readPng(const std::filesystem::path& file);

/// An X server of its own without a monitor, and hands on its mouse and keyboard.
class Screen {
  public:
    /// Null if there is no Xvfb, or it does not start.
    static std::unique_ptr<Screen> start(int width, int height);
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    /// For DISPLAY.
    const std::string& name() const { return name_; }

    /// The program's window, or 0 while there is none.
    Window window();
    std::string title();
    Image image();
    Rgb pixel(int x, int y) { return image().at(x, y); }

    /// What the settings of a desktop say of the size of text.
    void wantDotsPerInch(int dots);

    void moveMouse(int x, int y);
    void click(int x, int y);
    /// A hand takes some time from event to event; panels look at the mouse once a picture.
    void drag(int fromX, int fromY, int toX, int toY, Process::Seconds pause = Process::Seconds(0));
    /// Notches of the wheel, positive for forwards.
    void wheel(int x, int y, int notches);
    /// By the names of X: "space", "period", "1", "Escape".
    void press(const std::string& key);
    /// Gives the window the keyboard; without a window manager nobody else does.
    void focus();
    void resize(int width, int height);
    /// Presses a key, and says whether the window then asks its manager for all of the screen, or
    /// for its own size again.
    bool asksForFullScreen(const std::string& key, bool full);
    /// What the close button does.
    void close();
    /// Drags a file over the window and drops it there (the protocol XDND).
    bool drop(const std::filesystem::path& file, Process::Seconds timeout = Process::patience);

  private:
    Screen(std::unique_ptr<Process> server, std::string name, Display* display);

    std::unique_ptr<Process> server_;
    std::string name_;
    Display* display_;
};

/// Tries again and again until it holds; false if it does not for very long.
bool eventually(const std::function<bool()>& condition,
                Process::Seconds timeout = Process::patience);

}  // namespace quadrille
