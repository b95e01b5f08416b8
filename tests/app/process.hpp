#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace quadrille {

/// How a child process ended and what it printed.
struct ProcessResult {
    int exitCode = -1;  ///< 128 + the signal's number if a signal ended it, as in a shell
    bool timedOut = false;
    double peakBytes = 0;  ///< the most memory that it had at once
    std::string out, err;
};

/// A program that runs as a child process, with stdout and stderr captured apart and nothing on
/// stdin. It is killed if it outlives the object.
class Process {
  public:
    using Seconds = std::chrono::duration<double>;

    /// Far more than any run of the tests takes: what it ends is a program that hangs.
    static constexpr Seconds patience{120};

    /// Where its stderr goes to be read: a terminal is shown what a pipe is not.
    enum class Stderr { Pipe, Terminal };

    /// Throws std::system_error if no process can be made. A program that cannot be started exits
    /// with code 127.
    Process(const std::string& program, const std::vector<std::string>& arguments,
            Stderr stderrIs = Stderr::Pipe);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Reads on until the condition holds; false if the program ends or time runs out before.
    bool waitUntil(const std::function<bool()>& condition, Seconds timeout = patience);

    void sendSignal(int signal) const;

    /// Nobody reads its stdout any more.
    void closeOut();

    /// Waits for the end. Kills the program if it takes longer than that.
    ProcessResult finish(Seconds timeout = patience);

    /// What it has printed so far.
    const std::string& out() const { return captured_[0]; }
    const std::string& err() const { return captured_[1]; }

  private:
    using Clock = std::chrono::steady_clock;

    /// Takes what the pipes hold, or waits for it a short while; false when both are closed.
    bool read();
    void reap();

    pid_t child_ = -1;
    std::array<int, 2> pipes_{-1, -1};  // stdout, stderr
    std::array<std::string, 2> captured_;
};

}  // namespace quadrille
