#pragma once

#include "app/options.hpp"
#include "app/run_setup.hpp"

namespace quadrille::app {

/// Runs without a window until the options, or Ctrl-C, end it, and writes what was asked for.
void runHeadless(Run run, const Options& options);

}  // namespace quadrille::app
