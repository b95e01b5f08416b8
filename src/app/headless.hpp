#pragma once

#include "app/options.hpp"
#include "app/run_setup.hpp"

namespace quadrille::app {

/// Runs without a window until the options, or a signal, end it, and writes what was asked for.
/// Returns the program's exit code.
int runHeadless(Run run, const Options& options);

}  // namespace quadrille::app
