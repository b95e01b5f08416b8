// An instance file, in a scene that is right.

#include <string>

#include "core/support.hpp"
#include "fuzz/input.hpp"
#include "fuzz/scene_run.hpp"

namespace quadrille::fuzz {

bool tryInput(std::string_view input) {
    static const TemporaryFolder folder;
    static const auto scene = folder.write("scene.toml",
                                           "format = 1\n"
                                           "[world]\n"
                                           "size = [100, 50]\n"
                                           "walls = { thickness = 10, inset = 0 }\n"
                                           "[[instance]]\n"
                                           "file = \"rows.csv\"\n");
    folder.write("rows.csv", std::string(input));
    return loadsAndRuns(scene, precisionFor(input));
}

}  // namespace quadrille::fuzz
