#pragma once

#include <string>
#include <utility>
#include <vector>

namespace quadrille::bench {

/// What a figure depends on besides the engine: processor, cores, load, compiler, build, version,
/// commit and date (UTC), as pairs of name and value.
std::vector<std::pair<std::string, std::string>> describeMachine();

}  // namespace quadrille::bench
