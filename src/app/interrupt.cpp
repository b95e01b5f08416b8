#include "app/interrupt.hpp"

#include <csignal>

namespace quadrille::app {

namespace {

// A signal handler reaches nothing but globals.
volatile std::sig_atomic_t asked = 0;

extern "C" void ask(int signal) {
    asked = 1;
    std::signal(signal, SIG_DFL);
}

}  // namespace

void catchInterrupts() {
    std::signal(SIGINT, ask);
    std::signal(SIGTERM, ask);
}

bool interrupted() { return asked != 0; }

}  // namespace quadrille::app
