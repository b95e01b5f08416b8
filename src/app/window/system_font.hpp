#pragma once

#include <filesystem>
#include <vector>

namespace quadrille::app {

/// Where systems keep their fonts, and the user's own.
std::vector<std::filesystem::path> fontFolders();

/// A proportional font for text that is easy to read, the first of those that are known by name and
/// lie in one of these folders, or in that of their family there; an empty path where there is
/// none.
std::filesystem::path findFont(const std::vector<std::filesystem::path>& folders);

}  // namespace quadrille::app
