#include "app/scene_catalog.hpp"

#include <algorithm>
#include <fstream>
#include <system_error>

#include <quadrille/names.hpp>

#include "app/options.hpp"

namespace quadrille::app {

namespace {

namespace fs = std::filesystem;

/// Scenes lie beside an installed program, or in the source tree of one that was just built.
fs::path sceneFolder() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error) {
        fs::path installed = program.parent_path() / QUADRILLE_INSTALLED_SCENES;
        if (fs::is_directory(installed, error)) return installed;
    }
    return QUADRILLE_SOURCE_SCENES;
}

}  // namespace

std::vector<std::string> sceneNames() {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(sceneFolder(), error)) {
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::string aboutScene(const fs::path& file) {
    std::ifstream in(file);
    std::string comment;
    for (std::string line; std::getline(in, line) && line.starts_with('#');) {
        const std::size_t start = std::min(line.find_first_not_of("# "), line.size());
        comment += (comment.empty() ? "" : " ") + line.substr(start);
        while (!comment.empty() && (comment.back() == '\r' || comment.back() == ' ')) {
            comment.pop_back();
        }
    }
    const std::size_t end = comment.find(". ");
    return end == std::string::npos ? comment : comment.substr(0, end + 1);
}

bool isScenePath(const std::string& nameOrFile) {
    const fs::path path(nameOrFile);
    return path.has_parent_path() || path.extension() == ".toml";
}

fs::path findScene(const std::string& nameOrFile) {
    if (isScenePath(nameOrFile)) return nameOrFile;
    const auto names = sceneNames();
    if (std::find(names.begin(), names.end(), nameOrFile) != names.end()) {
        return sceneFolder() / (nameOrFile + ".toml");
    }
    std::string message = "--scene: '" + nameOrFile + "' is not known; valid: ";
    for (const std::string& name : names) message += name + ", ";
    throw UsageError(message + "or the path of a .toml file" +
                     didYouMean(nearestNames(nameOrFile, names)));
}

}  // namespace quadrille::app
