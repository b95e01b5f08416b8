#pragma once

#include <span>
#include <string>
#include <vector>

namespace quadrille::app {

/// A format of films that ffmpeg writes.
struct VideoFormat {
    const char* ending;                      ///< of the file's name, with the dot
    const char* name;                        ///< for messages
    const char* container;                   ///< ffmpeg's name for it
    std::span<const char* const> arguments;  ///< of its encoder
};

/// What the name of the file ends in; null for ".y4m", which needs no ffmpeg, and for others.
const VideoFormat* findVideoFormat(const std::string& file);

/// Whether a film can have that name.
bool isVideoName(const std::string& file);

/// All endings, for messages: ".mp4, .mkv, ...".
std::string videoEndings();

}  // namespace quadrille::app
