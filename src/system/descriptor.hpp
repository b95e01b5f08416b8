#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

namespace quadrille {

/// An open file of the operating system, closed at the end.
class Descriptor {
  public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { static_cast<void>(close()); }
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }

    explicit operator bool() const { return number_ >= 0; }
    int get() const { return number_; }

    /// Returns the errno of what could not be written, or 0.
    int close() noexcept;

  private:
    int number_ = -1;
};

// Functions that give a descriptor set errno where they give none; those that return an int return
// an errno, or 0.

/// A new file, for writing; fails if there is anything of that name, a link included. It is
/// readable by others unless it is `hidden`, for as long as it has not got its permissions.
Descriptor createExclusively(const std::string& file, bool hidden);

/// A device or a pipe that is there, for writing. Waits for the reader of a pipe.
Descriptor openSpecial(const std::filesystem::path& file);

/// For reading; does not wait for the writer of a pipe.
Descriptor openForReading(const std::filesystem::path& file);

/// What is open, if it is a regular file.
struct FileState {
    bool regular = false;
    std::uint64_t bytes = 0;
};
FileState stateOf(const Descriptor& file);

int writeAll(int descriptor, const char* data, std::size_t size);

/// Reads until `size` bytes are there or the file ends, and says how many there were.
int readAll(int descriptor, char* data, std::size_t size, std::size_t& done);

/// Waits until what was written is on the disk.
int flushToDisk(int descriptor);
int flushFolderToDisk(const std::filesystem::path& folder);

/// Gives an open file the permissions, and where that is allowed the owner, of another.
bool takePermissions(int descriptor, const std::filesystem::path& from);

/// Calls nothing that a signal handler must not call.
void removeFile(const char* name) noexcept;

}  // namespace quadrille
