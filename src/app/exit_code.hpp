#pragma once

namespace quadrille::app {

/// What the program tells the shell.
enum ExitCode : int {
    done = 0,
    runtimeFailure = 1,
    usageError = 2,
    badInput = 3,  ///< scene or snapshot
    noDevice = 4,
    interruptedBySignal = 128,  ///< plus the signal's number
};

}  // namespace quadrille::app
