#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace quadrille::app {

/// CLI::IsMember, which says which of the names a mistyped one may have meant.
CLI::Validator oneOf(std::vector<std::string> names);

}  // namespace quadrille::app
