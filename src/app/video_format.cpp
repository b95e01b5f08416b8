#include "app/video_format.hpp"

#include <array>
#include <string_view>

namespace quadrille::app {

namespace {

// Players take the colours of films of this size for BT.709, and most of them only 4:2:0, which has
// even sides.
#define QUADRILLE_COMMON_VIDEO                                                          \
    "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709,format=yuv420p", \
        "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"

constexpr std::array<const char*, 14> h264 = {
    QUADRILLE_COMMON_VIDEO, "-c:v", "libx264", "-preset", "veryfast", "-crf", "18"};
constexpr std::array<const char*, 18> vp9 = {QUADRILLE_COMMON_VIDEO,
                                             "-c:v",
                                             "libvpx-vp9",
                                             "-crf",
                                             "24",
                                             "-b:v",
                                             "0",
                                             "-deadline",
                                             "realtime",
                                             "-cpu-used",
                                             "8"};
// A palette for each picture, so that none has to be kept until the end.
constexpr std::array<const char*, 2> gif = {
    "-vf", "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1"};

#undef QUADRILLE_COMMON_VIDEO

constexpr VideoFormat formats[] = {
    {".mp4", "H.264 in MP4", "mp4", h264},
    {".mov", "H.264 in QuickTime", "mov", h264},
    {".mkv", "H.264 in Matroska", "matroska", h264},
    {".webm", "VP9 in WebM", "webm", vp9},
    {".gif", "GIF", "gif", gif},
};
constexpr std::string_view y4m = ".y4m";

}  // namespace

const VideoFormat* findVideoFormat(const std::string& file) {
    for (const VideoFormat& format : formats) {
        if (file.ends_with(format.ending)) return &format;
    }
    return nullptr;
}

bool isVideoName(const std::string& file) {
    return findVideoFormat(file) != nullptr || file.ends_with(y4m);
}

std::string videoEndings() {
    std::string text;
    for (const VideoFormat& format : formats) text += std::string(format.ending) + ", ";
    return text + std::string(y4m);
}

}  // namespace quadrille::app
