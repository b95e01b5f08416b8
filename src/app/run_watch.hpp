#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace quadrille::app {

/// Ends the program soon after a signal asked for that, in work that nothing interrupts: the main
/// thread looks for signals between two frames, and this one, from a thread of its own, inside one.
class RunWatch {
  public:
    using Clock = std::chrono::steady_clock;

    struct Hooks {
        /// Ends the run while the main thread is inside a section, which it never leaves again;
        /// returns the program's exit code. May touch whatever no section does.
        std::function<int(int signal)> takeOver;
        /// Called now and then while a section lasts, with the time since its start. May be empty.
        std::function<void(std::chrono::duration<double>)> progress;
    };

    explicit RunWatch(Hooks hooks);
    ~RunWatch();
    RunWatch(const RunWatch&) = delete;
    RunWatch& operator=(const RunWatch&) = delete;

    /// Runs `work`, which may last for any time: once a signal has asked for the end, it has the
    /// grace to finish, and is then left behind.
    template <class Work>
    void section(Clock::duration grace, Work&& work) {
        enter(grace);
        struct Left {
            RunWatch& watch;
            ~Left() { watch.leave(); }
        } const left{*this};
        work();
    }

  private:
    void enter(Clock::duration grace);
    void leave();
    void watch();

    Hooks hooks_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool inside_ = false, takenOver_ = false, over_ = false;
    Clock::duration grace_{};
    Clock::time_point entered_;
    std::thread thread_;  // last, since it uses the others
};

}  // namespace quadrille::app
