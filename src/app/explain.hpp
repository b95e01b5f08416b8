#pragma once

#include <iosfwd>

#include "app/run_setup.hpp"

namespace quadrille::app {

/// Prints what the scene makes the engine model, what it leaves out, and the bytes per body that
/// follow. `window` says that the run is to be seen.
void explain(std::ostream& out, const Run& run, bool window);

/// Prints the names that the options take.
void list(std::ostream& out);

}  // namespace quadrille::app
