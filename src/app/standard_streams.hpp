#pragma once

#include <filesystem>

namespace quadrille::app {

/// Puts the null device where stdin, stdout or stderr are closed: a file opened later would get
/// that number, and with it the words of the program.
void openStandardStreams();

/// Whether stdout or stderr goes to this regular file.
bool isStandardStream(const std::filesystem::path& file);

/// Throws Error if stdout was closed when the program started; for what nobody would ever read.
void requireStdout();

/// Throws Error if anything written to stdout was lost.
void finishStdout();

}  // namespace quadrille::app
