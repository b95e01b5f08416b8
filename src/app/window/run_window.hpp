#pragma once

#include "app/options.hpp"

namespace quadrille::app {

/// Runs in a window until the options, its close button or a signal end it, and writes what was
/// asked for. Returns the exit code of the program. Throws Error, with a hint at --headless, where
/// no window can be opened or this build has none.
int runWindow(const Options& options);

}  // namespace quadrille::app
