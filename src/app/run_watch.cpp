#include "app/run_watch.hpp"

#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>
#include <utility>

#include "app/exit_code.hpp"
#include "app/interrupt.hpp"
#include "app/standard_streams.hpp"
#include "system/whole_file.hpp"

namespace quadrille::app {

namespace {

using namespace std::chrono_literals;

/// Between two looks at what a signal handler has noted: nothing wakes a thread from in there.
constexpr auto period = 20ms;
/// From here on a section is long enough to say that it goes on.
constexpr auto longSection = 1s;

/// What `main` does with an exit code or an error, without leaving the stack that the main thread
/// still stands on.
[[noreturn]] void endProgram(const std::function<int(int)>& takeOver, int signal) {
    int exitCode = runtimeFailure;
    try {
        exitCode = takeOver(signal);
        finishStdout();
    } catch (const std::exception& error) {
        std::cerr << "collisionStress: " << error.what() << '\n';
        exitCode = runtimeFailure;
    }
    removeUnfinishedFiles();
    std::cout.flush();
    std::_Exit(exitCode);
}

/// Threads that are made meanwhile leave interrupts to the others: of two that come at once, the
/// main thread takes the lower one first.
class WithoutInterrupts {
  public:
#ifdef _WIN32
    WithoutInterrupts() {}
#else
    WithoutInterrupts() {
        sigset_t interrupts;
        sigemptyset(&interrupts);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&interrupts, signal);
        pthread_sigmask(SIG_BLOCK, &interrupts, &before_);
    }
    ~WithoutInterrupts() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

  private:
    sigset_t before_;
#endif
};

}  // namespace

RunWatch::RunWatch(Hooks hooks) : hooks_(std::move(hooks)) {
    const WithoutInterrupts here;
    thread_ = std::thread([this] { watch(); });
}

RunWatch::~RunWatch() {
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void RunWatch::enter(Clock::duration grace) {
    const std::lock_guard lock(mutex_);
    inside_ = true;
    grace_ = grace;
    entered_ = Clock::now();
}

void RunWatch::leave() {
    std::unique_lock lock(mutex_);
    inside_ = false;
    // The other thread ends the program.
    if (takenOver_) changed_.wait(lock, [] { return false; });
}

void RunWatch::watch() {
    std::optional<Clock::time_point> asked;
    std::unique_lock lock(mutex_);
    while (!over_) {
        changed_.wait_for(lock, period);
        if (over_ || !inside_) continue;
        const auto now = Clock::now();
        const int signal = interruptedBy();
        if (signal != 0) {
            if (!asked) asked = now;
            if (now - *asked < grace_) continue;
            takenOver_ = true;
            lock.unlock();
            endProgram(hooks_.takeOver, signal);
        }
        if (hooks_.progress && now - entered_ >= longSection) hooks_.progress(now - entered_);
    }
}

}  // namespace quadrille::app
