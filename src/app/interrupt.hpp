#pragma once

namespace quadrille::app {

/// From here on no signal that ends the program leaves an unfinished file behind, SIGKILL apart.
/// Signals that were ignored (nohup does that) stay ignored.
void cleanUpOnSignals();

/// From here on the first SIGINT, SIGTERM or SIGHUP asks the run to end instead of ending the
/// program; a second one ends it at once.
void catchInterrupts();

/// The signal that asked for the end, or 0.
int interruptedBy();

}  // namespace quadrille::app
