#include "system/descriptor.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace quadrille {

namespace {

/// No system takes more at once.
constexpr std::size_t mostAtOnce = std::size_t(1) << 30;

}  // namespace

#ifdef _WIN32

int Descriptor::close() noexcept {
    if (number_ < 0) return 0;
    return _close(std::exchange(number_, -1)) == 0 ? 0 : errno;
}

Descriptor createExclusively(const std::string& file, bool) {
    return Descriptor(_open(file.c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT,
                            _S_IREAD | _S_IWRITE));
}

Descriptor openSpecial(const std::filesystem::path& file) {
    return Descriptor(_open(file.string().c_str(), _O_WRONLY | _O_BINARY | _O_NOINHERIT));
}

Descriptor openForReading(const std::filesystem::path& file) {
    return Descriptor(_open(file.string().c_str(), _O_RDONLY | _O_BINARY | _O_NOINHERIT));
}

FileState stateOf(const Descriptor& file) {
    struct _stat64 state;
    if (_fstat64(file.get(), &state) != 0 || (state.st_mode & _S_IFMT) != _S_IFREG) return {};
    return {true, static_cast<std::uint64_t>(state.st_size)};
}

int writeAll(int descriptor, const char* data, std::size_t size) {
    while (size > 0) {
        const int done =
            _write(descriptor, data, static_cast<unsigned>(std::min(size, mostAtOnce)));
        if (done < 0) return errno;
        data += done;
        size -= static_cast<std::size_t>(done);
    }
    return 0;
}

int readAll(int descriptor, char* data, std::size_t size, std::size_t& done) {
    done = 0;
    while (done < size) {
        const int count = _read(descriptor, data + done,
                                static_cast<unsigned>(std::min(size - done, mostAtOnce)));
        if (count < 0) return errno;
        if (count == 0) break;
        done += static_cast<std::size_t>(count);
    }
    return 0;
}

int flushToDisk(int descriptor) { return _commit(descriptor) == 0 ? 0 : errno; }

// A folder cannot be opened there, and its entries are written in order.
int flushFolderToDisk(const std::filesystem::path&) { return 0; }

bool takePermissions(int, const std::filesystem::path&) { return true; }

void removeFile(const char* name) noexcept { static_cast<void>(_unlink(name)); }

#else

int Descriptor::close() noexcept {
    if (number_ < 0) return 0;
    // Closed even if a signal came in between.
    return ::close(std::exchange(number_, -1)) == 0 || errno == EINTR ? 0 : errno;
}

Descriptor createExclusively(const std::string& file, bool hidden) {
    return Descriptor(open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                           hidden ? 0600 : 0666));
}

Descriptor openSpecial(const std::filesystem::path& file) {
    return Descriptor(open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
}

Descriptor openForReading(const std::filesystem::path& file) {
    return Descriptor(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
}

FileState stateOf(const Descriptor& file) {
    struct stat state {};
    if (fstat(file.get(), &state) != 0 || !S_ISREG(state.st_mode)) return {};
    return {true, static_cast<std::uint64_t>(state.st_size)};
}

int writeAll(int descriptor, const char* data, std::size_t size) {
    while (size > 0) {
        const ssize_t done = write(descriptor, data, std::min(size, mostAtOnce));
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) return errno;
        data += done;
        size -= static_cast<std::size_t>(done);
    }
    return 0;
}

int readAll(int descriptor, char* data, std::size_t size, std::size_t& done) {
    done = 0;
    while (done < size) {
        const ssize_t count = read(descriptor, data + done, std::min(size - done, mostAtOnce));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno;
        if (count == 0) break;
        done += static_cast<std::size_t>(count);
    }
    return 0;
}

namespace {

/// Some file systems have nothing to wait for, and say so.
bool nothingToFlush(int error) { return error == EINVAL || error == ENOTSUP || error == ENOSYS; }

}  // namespace

int flushToDisk(int descriptor) {
    while (fsync(descriptor) != 0) {
        if (nothingToFlush(errno)) return 0;
        if (errno != EINTR) return errno;
    }
    return 0;
}

int flushFolderToDisk(const std::filesystem::path& folder) {
    const Descriptor open(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    // A folder may be writable and not readable.
    if (!open) return errno == EACCES ? 0 : errno;
    return flushToDisk(open.get());
}

bool takePermissions(int descriptor, const std::filesystem::path& from) {
    struct stat wanted {
    }, now{};
    if (stat(from.c_str(), &wanted) != 0) return errno == ENOENT;  // gone meanwhile
    if (fstat(descriptor, &now) != 0) return false;
    mode_t mode = wanted.st_mode & 0777;
    if (wanted.st_uid != now.st_uid || wanted.st_gid != now.st_gid) {
        const bool taken = fchown(descriptor, wanted.st_uid, wanted.st_gid) == 0 ||
                           fchown(descriptor, static_cast<uid_t>(-1), wanted.st_gid) == 0;
        // What the old group was allowed is not for another.
        if (!taken) mode &= ~mode_t(0070);
    }
    return fchmod(descriptor, mode) == 0;
}

void removeFile(const char* name) noexcept { static_cast<void>(unlink(name)); }

#endif

}  // namespace quadrille
