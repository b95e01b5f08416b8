#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "system/descriptor.hpp"

namespace quadrille {

/// Where the program of this name lies on the PATH; an empty path if nowhere.
std::filesystem::path findProgram(const std::string& name);

/// A program that runs beside this one and reads what it is given. It is in a process group of its
/// own, so that Ctrl-C does not reach it: who gives it its input says when that ends.
class ProgramPipe {
  public:
    /// Its stdout goes nowhere, its stderr where that of this program goes. Throws Error if it
    /// cannot be started.
    ProgramPipe(const std::filesystem::path& program, const std::vector<std::string>& arguments);
    /// Kills it unless it has been waited for.
    ~ProgramPipe();
    ProgramPipe(const ProgramPipe&) = delete;
    ProgramPipe& operator=(const ProgramPipe&) = delete;

    /// False if it reads no more.
    bool write(const char* data, std::size_t size);

    /// Ends its input and waits for its end. Returns its exit code, or 128 + the number of the
    /// signal that ended it.
    int finish();

  private:
    Descriptor input_;
    int process_ = 0;
};

}  // namespace quadrille
