#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quadrille::app {

/// The scene files that come with the program, by name.
std::vector<std::string> sceneNames();

/// What a scene file says of itself: the first sentence of the comment that it begins with, or
/// nothing.
std::string aboutScene(const std::filesystem::path& file);

/// What a window opens on, since something happens in it.
inline constexpr const char* openingScene = "gap";

/// Whether this is the path of a file and not a name.
bool isScenePath(const std::string& nameOrFile);

/// The file of a shipped scene, or of a path. Throws UsageError, listing the valid names, if it is
/// neither a name nor something that looks like a path.
std::filesystem::path findScene(const std::string& nameOrFile);

}  // namespace quadrille::app
