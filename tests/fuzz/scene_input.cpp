// A scene file. The instance file rows.csv lies beside it.

#include <string>

#include "core/support.hpp"
#include "fuzz/input.hpp"
#include "fuzz/scene_run.hpp"

namespace quadrille::fuzz {

bool tryInput(std::string_view input) {
    static const TemporaryFolder folder;
    static const auto rows = folder.write("rows.csv", "x,y,vx,vy\n1,2,3,4\n-5,6,-7,8\n");
    return loadsAndRuns(folder.write("scene.toml", std::string(input)), precisionFor(input));
}

}  // namespace quadrille::fuzz
