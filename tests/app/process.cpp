#include "process.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace quadrille {

namespace {

[[noreturn]] void fail(const char* call) {
    throw std::system_error(errno, std::generic_category(), call);
}

/// The read and the write end; no other child inherits them.
std::array<int, 2> makePipe() {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) fail("pipe");
    for (const int end : ends) fcntl(end, F_SETFD, FD_CLOEXEC);
    return ends;
}

/// The same of a pseudo-terminal.
std::array<int, 2> makeTerminal() {
    const int read = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (read < 0 || grantpt(read) != 0 || unlockpt(read) != 0) fail("posix_openpt");
    const char* const name = ptsname(read);
    const int write = name == nullptr ? -1 : open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
    if (write < 0) fail("ptsname");
    return {read, write};
}

}  // namespace

Process::Process(const std::string& program, const std::vector<std::string>& arguments,
                 Stderr stderrIs) {
    // All memory is allocated before the fork.
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const auto out = makePipe();
    const auto err = stderrIs == Stderr::Terminal ? makeTerminal() : makePipe();
    child_ = fork();
    if (child_ < 0) fail("fork");
    if (child_ == 0) {
        // Whatever the test runs under: a shell's background job ignores some of them.
        for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM}) {
            std::signal(signal, SIG_DFL);
        }
        const rlimit none{};
        setrlimit(RLIMIT_CORE, &none);  // some tests end it by a signal that dumps one
        const int in = open("/dev/null", O_RDONLY);
        const bool ready = dup2(in, STDIN_FILENO) >= 0 && dup2(out[1], STDOUT_FILENO) >= 0 &&
                           dup2(err[1], STDERR_FILENO) >= 0;
        if (ready) execv(program.c_str(), argv.data());
        _exit(127);
    }
    close(out[1]);
    close(err[1]);
    pipes_ = {out[0], err[0]};
}

Process::~Process() {
    if (child_ > 0) {
        kill(child_, SIGKILL);
        reap();
    }
    for (const int end : pipes_) {
        if (end >= 0) close(end);
    }
}

bool Process::waitUntil(const std::function<bool()>& condition, Seconds timeout) {
    const auto start = Clock::now();
    while (!condition()) {
        if (!read() || Clock::now() - start > timeout) return condition();
    }
    return true;
}

void Process::sendSignal(int signal) const {
    if (child_ > 0 && kill(child_, signal) != 0) fail("kill");
}

void Process::closeOut() {
    if (pipes_[0] >= 0) close(std::exchange(pipes_[0], -1));
}

ProcessResult Process::finish(Seconds timeout) {
    ProcessResult result;
    const auto start = Clock::now();
    while (read()) {
        if (!result.timedOut && Clock::now() - start > timeout) {
            result.timedOut = true;
            kill(child_, SIGKILL);
        }
    }
    int status = 0;
    rusage usage{};
    while (wait4(child_, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    child_ = -1;
    result.peakBytes = 1024 * double(usage.ru_maxrss);
    result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.out = captured_[0];
    result.err = captured_[1];
    return result;
}

bool Process::read() {
    // poll passes over the negative descriptor of a pipe that is closed.
    std::array<pollfd, 2> polled{};
    for (std::size_t i = 0; i < polled.size(); ++i) polled[i] = {pipes_[i], POLLIN, 0};
    if (pipes_[0] < 0 && pipes_[1] < 0) return false;
    constexpr int milliseconds = 20;
    if (poll(polled.data(), polled.size(), milliseconds) < 0 && errno != EINTR) fail("poll");
    for (std::size_t i = 0; i < polled.size(); ++i) {
        if (polled[i].revents == 0) continue;
        std::array<char, 65536> buffer;
        const ssize_t size = ::read(pipes_[i], buffer.data(), buffer.size());
        if (size > 0) {
            captured_[i].append(buffer.data(), static_cast<std::size_t>(size));
        } else if (size == 0 || errno != EINTR) {
            close(pipes_[i]);
            pipes_[i] = -1;
        }
    }
    return true;
}

void Process::reap() {
    while (waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
}

}  // namespace quadrille
