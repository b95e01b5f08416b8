#include "system/whole_file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <random>
#include <streambuf>
#include <string>
#include <system_error>
#include <utility>

#include <quadrille/error.hpp>

#include "system/descriptor.hpp"

namespace quadrille {

namespace fs = std::filesystem;

namespace {

std::string reasonOf(int error) { return std::generic_category().message(error); }

/// The names of the files that are not committed. A signal handler reaches nothing but globals, so
/// there is a fixed number of places: more than a program ever writes at the same time.
class UnfinishedFiles {
  public:
    /// The text must stay where it is until `forget`.
    void remember(const char* name) noexcept {
        for (std::atomic<const char*>& place : places_) {
            const char* none = nullptr;
            if (place.compare_exchange_strong(none, name)) return;
        }
    }

    /// False if a handler took the name, and may still be reading it, or if there was no place.
    bool forget(const char* name) noexcept {
        for (std::atomic<const char*>& place : places_) {
            const char* expected = name;
            if (place.compare_exchange_strong(expected, nullptr)) return true;
        }
        return false;
    }

    void removeAll() noexcept {
        for (std::atomic<const char*>& place : places_) {
            if (const char* name = place.exchange(nullptr)) removeFile(name);
        }
    }

  private:
    static_assert(std::atomic<const char*>::is_always_lock_free);
    std::array<std::atomic<const char*>, 64> places_{};
};

constinit UnfinishedFiles unfinishedFiles;

/// What a chain of links points to, be it there or not.
fs::path followLinks(fs::path file) {
    constexpr int longestChain = 40;
    for (int i = 0; i < longestChain; ++i) {
        std::error_code error;
        if (!fs::is_symlink(fs::symlink_status(file, error))) return file;
        const fs::path next = fs::read_symlink(file, error);
        if (error) return file;
        file = file.parent_path() / next;
    }
    throw Error(file.string() + ": " + reasonOf(ELOOP));
}

fs::path folderOf(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

std::uint64_t randomNumber() {
    try {
        std::random_device random;
        return std::uint64_t(random()) << 32 | random();
    } catch (const std::exception&) {
        // No source of chance: the time differs from run to run, and a name that is taken is
        // noticed.
        return static_cast<std::uint64_t>(
            std::chrono::high_resolution_clock::now().time_since_epoch().count());
    }
}

/// Beside the target, so that a rename suffices, and so that no two runs ever have the same.
fs::path temporaryBeside(const fs::path& target) {
    std::array<char, 24> suffix{};
    std::snprintf(suffix.data(), suffix.size(), ".%016llx.part",
                  static_cast<unsigned long long>(randomNumber()));
    // A file system takes names of up to 255 bytes.
    constexpr std::size_t longest = 200;
    const std::string name = target.filename().string();
    const std::string stem = name.size() > longest ? "quadrille" : name;
    return folderOf(target) / (stem + suffix.data());
}

/// A stream's buffer that writes to a descriptor and remembers why it failed.
class DescriptorBuffer : public std::streambuf {
  public:
    explicit DescriptorBuffer(int descriptor) : descriptor_(descriptor) {
        setp(buffer_.data(), buffer_.data() + buffer_.size());
    }

    /// 0, or the errno of the first write that failed.
    int error() const { return error_; }

  protected:
    int_type overflow(int_type next) override {
        if (sync() != 0) return traits_type::eof();
        if (traits_type::eq_int_type(next, traits_type::eof())) return traits_type::not_eof(next);
        return sputc(traits_type::to_char_type(next));
    }

    int sync() override {
        const auto size = static_cast<std::size_t>(pptr() - pbase());
        if (error_ == 0) error_ = writeAll(descriptor_, pbase(), size);
        setp(buffer_.data(), buffer_.data() + buffer_.size());
        return error_ == 0 ? 0 : -1;
    }

  private:
    int descriptor_;
    int error_ = 0;
    std::array<char, 1 << 16> buffer_;
};

}  // namespace

class WholeFile::Impl {
  public:
    Impl(const fs::path& name, Special special) : name_(name.string()) {
        // Absolute: the program may be in another folder when it commits.
        std::error_code error;
        target_ = fs::absolute(followLinks(name), error);
        if (error || !target_.has_filename()) fail("is not the name of a file");
        const fs::file_status status = fs::status(target_, error);
        if (fs::is_directory(status)) fail("is a folder");
        if (fs::exists(status) && !fs::is_regular_file(status)) {
            if (special == Special::Refuse) fail("is not a file that can be replaced");
            descriptor_ = openSpecial(target_);
            if (!descriptor_) fail("cannot be written: " + reasonOf(errno));
        } else {
            openTemporary(fs::exists(status));
        }
        buffer_ = std::make_unique<DescriptorBuffer>(descriptor_.get());
        stream_.rdbuf(buffer_.get());
    }

    ~Impl() {
        descriptor_.close();
        if (!temporary_ || committed_) return;
        removeFile(temporary_->c_str());
        forgetTemporary();
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    std::ostream& stream() { return stream_; }
    fs::path temporary() const { return temporary_ ? fs::path(*temporary_) : fs::path(); }

    void commit() {
        stream_.flush();
        if (buffer_->error() != 0) fail("cannot be written: " + reasonOf(buffer_->error()));
        if (!stream_) fail("cannot be written");
        if (temporary_) {
            if (const int error = flushToDisk(descriptor_.get())) {
                fail("cannot be written: " + reasonOf(error));
            }
        }
        if (const int error = descriptor_.close()) {
            fail("cannot be written: " + reasonOf(error));
        }
        if (!temporary_) return;
        std::error_code error;
        fs::rename(*temporary_, target_, error);
        if (error) fail("cannot be written: " + error.message());
        committed_ = true;
        forgetTemporary();
        // The file is whole, but a crash of the machine could still take its name away.
        if (const int failure = flushFolderToDisk(folderOf(target_))) {
            fail("its folder cannot be written: " + reasonOf(failure));
        }
    }

  private:
    [[noreturn]] void fail(const std::string& reason) const { throw Error(name_ + ": " + reason); }

    void openTemporary(bool replaces) {
        for (int attempt = 0; !descriptor_; ++attempt) {
            temporary_ = std::make_unique<std::string>(temporaryBeside(target_).string());
            // Known before it is there: a signal may come in between.
            unfinishedFiles.remember(temporary_->c_str());
            descriptor_ = createExclusively(*temporary_, replaces);
            if (descriptor_) break;
            const int error = errno;
            forgetTemporary();
            if (error != EEXIST || attempt == 8) fail("cannot be written: " + reasonOf(error));
        }
        if (!replaces || takePermissions(descriptor_.get(), target_)) return;
        const int error = errno;
        removeFile(temporary_->c_str());
        forgetTemporary();
        fail("its permissions cannot be kept: " + reasonOf(error));
    }

    void forgetTemporary() {
        // A handler that has the name ends the program, and must not find other bytes there.
        if (!unfinishedFiles.forget(temporary_->c_str())) static_cast<void>(temporary_.release());
        temporary_.reset();
    }

    std::string name_;
    fs::path target_;
    std::unique_ptr<std::string> temporary_;  // absent if nothing is to be renamed
    Descriptor descriptor_;
    std::unique_ptr<DescriptorBuffer> buffer_;
    std::ostream stream_{nullptr};
    bool committed_ = false;
};

WholeFile::WholeFile(const fs::path& target, Special special)
    : impl_(std::make_unique<Impl>(target, special)) {}

WholeFile::~WholeFile() = default;

std::ostream& WholeFile::stream() { return impl_->stream(); }

fs::path WholeFile::temporary() const { return impl_->temporary(); }

void WholeFile::commit() { impl_->commit(); }

void removeUnfinishedFiles() noexcept { unfinishedFiles.removeAll(); }

bool sameFile(const fs::path& a, const fs::path& b) {
    const fs::path targetA = followLinks(a), targetB = followLinks(b);
    std::error_code error;
    const bool thereA = fs::exists(targetA, error), thereB = fs::exists(targetB, error);
    if (thereA != thereB) return false;
    if (thereA) return fs::equivalent(targetA, targetB, error);
    return targetA.filename() == targetB.filename() &&
           fs::equivalent(folderOf(targetA), folderOf(targetB), error);
}

}  // namespace quadrille
