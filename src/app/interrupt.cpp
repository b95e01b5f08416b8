#include "app/interrupt.hpp"

#include <atomic>
#include <csignal>

#include "system/whole_file.hpp"

namespace quadrille::app {

namespace {

// A signal handler reaches nothing but globals, and may run in any thread.
std::atomic<bool> catching = false;
std::atomic<int> asked = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

bool asksForTheEnd(int signal) {
#ifdef SIGHUP
    if (signal == SIGHUP) return true;
#endif
    return signal == SIGINT || signal == SIGTERM;
}

extern "C" void onSignal(int signal) {
    int none = 0;
    if (catching && asksForTheEnd(signal) && asked.compare_exchange_strong(none, signal)) return;
    removeUnfinishedFiles();
    // Ends the program as it would have ended without this handler, so that whoever started it
    // sees the signal.
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

/// Others, such as a sanitizer, may have a use for the signal already.
void handle(int signal) {
#ifdef _WIN32
    std::signal(signal, onSignal);
#else
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) != 0 || (action.sa_flags & SA_SIGINFO) != 0 ||
        action.sa_handler != SIG_DFL) {
        return;
    }
    action.sa_handler = onSignal;
    action.sa_flags = SA_RESTART;  // a stream takes an interrupted write for a failure
    sigfillset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
#endif
}

}  // namespace

void cleanUpOnSignals() {
    for (const int signal : {SIGINT, SIGTERM, SIGABRT}) handle(signal);
#ifndef _WIN32
    for (const int signal :
         {SIGHUP, SIGPIPE, SIGQUIT, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU, SIGVTALRM, SIGPROF, SIGSEGV,
          SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP}) {
        handle(signal);
    }
    // A file beyond the limit is an error like a full disk, with a message.
    std::signal(SIGXFSZ, SIG_IGN);
#endif
}

void catchInterrupts() { catching = true; }

int interruptedBy() { return asked; }

}  // namespace quadrille::app
