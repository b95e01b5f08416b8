#include "system/program_pipe.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include <quadrille/error.hpp>

#ifndef _WIN32
#include <array>
#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;
#endif

namespace quadrille {

namespace fs = std::filesystem;

#ifdef _WIN32

fs::path findProgram(const std::string&) { return {}; }

ProgramPipe::ProgramPipe(const fs::path& program, const std::vector<std::string>&) {
    throw Error(program.string() + ": programs cannot be started on this system");
}
ProgramPipe::~ProgramPipe() = default;
bool ProgramPipe::write(const char*, std::size_t) { return false; }
int ProgramPipe::finish() { return 1; }

#else

namespace {

/// A pipe whose reader is gone says so by an error, and not by a signal that ends the program.
class WithoutPipeSignal {
  public:
    WithoutPipeSignal() {
        sigemptyset(&pipe_);
        sigaddset(&pipe_, SIGPIPE);
        sigset_t pending;
        sigpending(&pending);
        wasPending_ = sigismember(&pending, SIGPIPE) == 1;
        pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    ~WithoutPipeSignal() {
        sigset_t pending;
        sigpending(&pending);
        int taken = 0;
        if (!wasPending_ && sigismember(&pending, SIGPIPE) == 1) sigwait(&pipe_, &taken);
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    WithoutPipeSignal(const WithoutPipeSignal&) = delete;
    WithoutPipeSignal& operator=(const WithoutPipeSignal&) = delete;

  private:
    sigset_t pipe_{}, before_{};
    bool wasPending_ = false;
};

}  // namespace

fs::path findProgram(const std::string& name) {
    const char* const path = std::getenv("PATH");
    const std::string folders = path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin";
    for (std::size_t begin = 0; begin <= folders.size();) {
        const std::size_t end = std::min(folders.find(':', begin), folders.size());
        fs::path file = fs::path(folders.substr(begin, end - begin)) / name;
        std::error_code error;
        // Nothing is run from the current folder.
        if (file.is_absolute() && fs::is_regular_file(file, error) &&
            access(file.c_str(), X_OK) == 0)
            return file;
        begin = end + 1;
    }
    return {};
}

ProgramPipe::ProgramPipe(const fs::path& program, const std::vector<std::string>& arguments) {
    std::array<int, 2> ends{};
    const auto fail = [&](int error) {
        throw Error(program.string() +
                    ": cannot be started: " + std::generic_category().message(error));
    };
    if (pipe(ends.data()) != 0) fail(errno);
    const Descriptor output(ends[0]);
    input_ = Descriptor(ends[1]);
    // Other programs that are started must not hold it open.
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);

    std::vector<char*> texts{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) {
        texts.push_back(const_cast<char*>(argument.c_str()));
    }
    texts.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setpgroup(&attributes, 0);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    const int error =
        posix_spawn(&process_, program.c_str(), &actions, &attributes, texts.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
        process_ = 0;
        fail(error);
    }
}

ProgramPipe::~ProgramPipe() {
    if (process_ == 0) return;
    kill(process_, SIGKILL);
    finish();
}

bool ProgramPipe::write(const char* data, std::size_t size) {
    const WithoutPipeSignal guard;
    return writeAll(input_.get(), data, size) == 0;
}

int ProgramPipe::finish() {
    input_.close();
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

#endif

}  // namespace quadrille
