#include "app/standard_streams.hpp"

#include <iostream>

#ifndef _WIN32
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#include <quadrille/error.hpp>

namespace quadrille::app {

namespace {

bool stdoutWasClosed = false;

}  // namespace

void openStandardStreams() {
#ifndef _WIN32
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) >= 0) continue;
        if (stream == STDOUT_FILENO) stdoutWasClosed = true;
        // The lowest number that is free, and so this one.
        static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY));
    }
#endif
}

bool isStandardStream([[maybe_unused]] const std::filesystem::path& file) {
#ifndef _WIN32
    struct stat named {
    }, open{};
    if (stat(file.c_str(), &named) != 0 || !S_ISREG(named.st_mode)) return false;
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
        if (fstat(stream, &open) == 0 && open.st_dev == named.st_dev &&
            open.st_ino == named.st_ino) {
            return true;
        }
    }
#endif
    return false;
}

void requireStdout() {
    if (stdoutWasClosed) throw Error("stdout: is closed");
}

void finishStdout() {
    std::cout.flush();
    if (!std::cout) throw Error("stdout: cannot be written");
}

}  // namespace quadrille::app
