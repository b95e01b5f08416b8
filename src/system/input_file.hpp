#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace quadrille {

/// The content of a regular file of at most so many bytes. Anything else, be it a device that never
/// ends or a pipe that nobody writes to, is refused at once. Throws Error, which says what is wrong
/// and leaves it to the caller to name the file.
std::string readRegularFile(const std::filesystem::path& file, std::uint64_t mostBytes);

/// Text without the byte order mark that some editors begin it with.
void dropByteOrderMark(std::string& text);

}  // namespace quadrille
