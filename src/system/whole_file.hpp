#pragma once

#include <filesystem>
#include <memory>
#include <ostream>

namespace quadrille {

/// A file that appears whole or not at all, whatever ends the program: it grows beside the target
/// under a name that nobody else has, `TARGET.<16 hexadecimal digits>.part`, and takes the target's
/// name at `commit`, when it is on the disk. Of several that are written to one name at the same
/// time the last to be committed stays, whole. A link stays, and what it points to is replaced; a
/// file that is replaced hands its permissions on.
class WholeFile {
  public:
    /// What to do with a device or a pipe, which nothing may replace.
    enum class Special { Refuse, WriteTo };

    /// Throws Error, which names the file, if it cannot be written.
    explicit WholeFile(const std::filesystem::path& target, Special special = Special::Refuse);
    /// Takes away what was not committed.
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    /// Errors on the way are kept until `commit`.
    std::ostream& stream();

    /// Where it grows, for a program that writes it by itself; not of a device or a pipe.
    std::filesystem::path temporary() const;

    /// Throws Error, which names the file, if anything could not be written; the target is then as
    /// it was.
    void commit();

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

/// Takes away every file that is not committed yet. For a signal handler that ends the program: it
/// calls nothing that a handler must not call, and may run while another thread writes.
void removeUnfinishedFiles() noexcept;

/// Whether two names are, or would become, one file: by way of links, of hard links, or of another
/// spelling.
bool sameFile(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace quadrille
