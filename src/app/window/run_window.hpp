#pragma once

#include "app/options.hpp"

namespace quadrille::app {

/// Runs in a window until the options, its close button or Ctrl-C end it, and writes what was asked
/// for. Throws Error, with a hint at --headless, where no window can be opened or this build has
/// none.
void runWindow(const Options& options);

}  // namespace quadrille::app
