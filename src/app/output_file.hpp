#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

namespace quadrille::app {

/// A result file that appears whole or not at all: it grows under another name beside the target
/// and takes the target's name at `commit`. The name "-" is stdout. A link stays, and its target is
/// replaced; a device or a pipe is never replaced but written to.
class OutputFile {
  public:
    /// Throws Error if it cannot be written.
    explicit OutputFile(const std::string& name);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    std::ostream& stream();

    /// Throws Error if anything could not be written.
    void commit();

  private:
    std::string name_;
    std::filesystem::path target_, temporary_;  // empty if nothing is to be renamed
    std::ofstream file_;
    bool committed_ = false;
};

/// The shortest text that reads back as the same number.
std::string exact(double value);
std::string exact(float value);

}  // namespace quadrille::app
