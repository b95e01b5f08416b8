#pragma once

#include <stdexcept>

namespace quadrille {

/// Base of every error that Quadrille throws on purpose.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A scene file that cannot be read; the text names file, line, column and key.
class SceneError : public Error {
  public:
    using Error::Error;
};

/// A snapshot that is damaged, of another format or of another program.
class SnapshotError : public Error {
  public:
    using Error::Error;
};

/// A device that is missing, out of memory or lost.
class DeviceError : public Error {
  public:
    using Error::Error;
};

/// A combination of options that this version or build cannot run.
class NotAvailable : public Error {
  public:
    using Error::Error;
};

}  // namespace quadrille
