#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>

namespace quadrille::app {

/// A result file that appears whole or not at all: it grows under another name beside the target
/// and takes the target's name at `commit`. The name "-" is stdout.
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
    std::filesystem::path temporary_;
    std::ofstream file_;
    bool committed_ = false;
};

/// The shortest text that reads back as the same number.
std::string exact(double value);
std::string exact(float value);

}  // namespace quadrille::app
