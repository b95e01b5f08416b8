#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace quadrille::app {

/// A picture, 3 bytes a pixel, from the top row.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

/// The picture that was drawn and not yet presented.
Picture readFramebuffer(int width, int height);

/// Throws Error if it cannot be written.
void writePng(const std::string& file, const Picture& picture);

}  // namespace quadrille::app
