#pragma once

#include <optional>
#include <ostream>
#include <string>

#include "system/whole_file.hpp"

namespace quadrille::app {

/// A result file that appears whole or not at all (system/whole_file.hpp); the name "-" is stdout.
/// A device or a pipe is never replaced but written to.
class OutputFile {
  public:
    /// Throws Error if it cannot be written.
    explicit OutputFile(const std::string& name);

    std::ostream& stream();

    /// Throws Error if anything could not be written.
    void commit();

  private:
    std::optional<WholeFile> file_;  // absent for stdout
};

/// The shortest text that reads back as the same number.
std::string exact(double value);
std::string exact(float value);

}  // namespace quadrille::app
