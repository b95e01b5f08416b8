#pragma once

namespace quadrille::app {

/// From here on Ctrl-C and SIGTERM ask the run to end instead of killing the program; a second one
/// kills it.
void catchInterrupts();

bool interrupted();

}  // namespace quadrille::app
