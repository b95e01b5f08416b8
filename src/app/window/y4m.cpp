#include "app/window/y4m.hpp"

#include <cstddef>

namespace quadrille::app {

namespace {

struct Plane {
    int r, g, b, offset;  // of 256

    char of(const unsigned char* rgb) const {
        return static_cast<char>((r * rgb[0] + g * rgb[1] + b * rgb[2] + 128 + 256 * offset) >> 8);
    }
};

constexpr Plane planes[] = {{66, 129, 25, 16}, {-38, -74, 112, 128}, {112, -94, -18, 128}};

}  // namespace

std::string y4mHead(int width, int height, int picturesPerSecond) {
    return "YUV4MPEG2 W" + std::to_string(width) + " H" + std::to_string(height) + " F" +
           std::to_string(picturesPerSecond) + ":1 Ip A1:1 C444\n";
}

void addY4mPicture(std::ostream& out, const Picture& picture) {
    out << "FRAME\n";
    const std::size_t pixels = std::size_t(picture.width) * std::size_t(picture.height);
    std::string plane(pixels, 0);
    for (const Plane& weights : planes) {
        for (std::size_t i = 0; i < pixels; ++i) plane[i] = weights.of(&picture.rgb[3 * i]);
        out.write(plane.data(), static_cast<std::streamsize>(pixels));
    }
}

}  // namespace quadrille::app
