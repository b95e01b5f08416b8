#include "app/window/system_font.hpp"

#include <array>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace quadrille::app {

namespace fs = std::filesystem;

namespace {

/// From the best.
constexpr std::array<std::string_view, 9> fontFiles = {
    "DejaVuSans.ttf",     "NotoSans-Regular.ttf", "LiberationSans-Regular.ttf",
    "Roboto-Regular.ttf", "OpenSans-Regular.ttf", "FreeSans.ttf",
    "Ubuntu-R.ttf",       "segoeui.ttf",          "Arial.ttf"};

/// As distributions name them.
constexpr std::array<std::string_view, 17> familyFolders = {"",
                                                            "truetype/dejavu",
                                                            "truetype/noto",
                                                            "truetype/liberation",
                                                            "truetype/liberation2",
                                                            "truetype/roboto/unhinted/RobotoTTF",
                                                            "truetype/open-sans",
                                                            "truetype/freefont",
                                                            "truetype/ubuntu",
                                                            "TTF",
                                                            "dejavu",
                                                            "noto",
                                                            "liberation",
                                                            "dejavu-sans-fonts",
                                                            "google-noto",
                                                            "liberation-sans-fonts",
                                                            "Supplemental"};

}  // namespace

std::vector<fs::path> fontFolders() {
    std::vector<fs::path> folders;
    const char* const home = std::getenv("HOME");
    if (home != nullptr && *home != 0) {
        folders.push_back(fs::path(home) / ".local/share/fonts");
        folders.push_back(fs::path(home) / ".fonts");
    }
    for (const char* folder : {"/usr/local/share/fonts", "/usr/share/fonts",
                               "/System/Library/Fonts", "/Library/Fonts", "C:/Windows/Fonts"}) {
        folders.emplace_back(folder);
    }
    return folders;
}

fs::path findFont(const std::vector<fs::path>& folders) {
    for (const std::string_view file : fontFiles) {
        for (const fs::path& folder : folders) {
            for (const std::string_view family : familyFolders) {
                fs::path path = folder / family / file;
                std::error_code error;
                if (fs::is_regular_file(path, error)) return path;
            }
        }
    }
    return {};
}

}  // namespace quadrille::app
