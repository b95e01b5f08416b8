#include "bench/scene_files.hpp"

#include <algorithm>
#include <filesystem>

#include <quadrille/error.hpp>

namespace quadrille::bench {

namespace {

std::filesystem::path folder() { return QUADRILLE_SCENES_DIR; }

std::filesystem::path findScene(const std::string& nameOrFile) {
    auto shipped = folder() / (nameOrFile + ".toml");
    if (std::filesystem::exists(shipped)) return shipped;
    if (std::filesystem::is_regular_file(nameOrFile)) return nameOrFile;
    std::string names;
    for (const std::string& name : shippedScenes()) names += " " + name;
    throw Error("scene '" + nameOrFile + "' is neither a file nor one of:" + names);
}

}  // namespace

Scene openScene(const std::string& nameOrFile, std::optional<std::uint64_t> entities) {
    SceneOptions options;
    options.entities = entities;
    return loadScene(findScene(nameOrFile), options);
}

std::vector<std::string> shippedScenes() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder())) {
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace quadrille::bench
