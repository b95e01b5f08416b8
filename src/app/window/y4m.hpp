#pragma once

#include <ostream>
#include <string>

#include "app/window/screenshot.hpp"

namespace quadrille::app {

/// The head of a film in Y4M: pictures one after the other, each pixel with its own colour (4:4:4).
std::string y4mHead(int width, int height, int picturesPerSecond);

/// Adds a picture of that size: a line, then the planes Y, Cb and Cr as ITU-R BT.601 defines them
/// for video.
void addY4mPicture(std::ostream& out, const Picture& picture);

}  // namespace quadrille::app
