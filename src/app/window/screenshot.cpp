#include "app/window/screenshot.hpp"

#include <algorithm>
#include <epoxy/gl.h>

#include <quadrille/error.hpp>

#include "app/output_file.hpp"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

namespace quadrille::app {

Picture readFramebuffer(int width, int height) {
    Picture picture{width, height, {}};
    const std::size_t row = std::size_t(width) * 3;
    picture.rgb.resize(row * std::size_t(height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadBuffer(GL_BACK);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, picture.rgb.data());
    // OpenGL counts rows from below.
    auto top = picture.rgb.begin();
    auto bottom = picture.rgb.end();
    for (int y = 0; y < height / 2; ++y) {
        bottom -= static_cast<std::ptrdiff_t>(row);
        std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(row), bottom);
        top += static_cast<std::ptrdiff_t>(row);
    }
    return picture;
}

void writePng(const std::string& file, const Picture& picture) {
    OutputFile out(file);
    const auto write = [](void* context, void* data, int size) {
        static_cast<OutputFile*>(context)->stream().write(static_cast<const char*>(data), size);
    };
    if (stbi_write_png_to_func(write, &out, picture.width, picture.height, 3, picture.rgb.data(),
                               3 * picture.width) == 0) {
        throw Error(file + ": the picture cannot be compressed");
    }
    out.commit();
}

}  // namespace quadrille::app
