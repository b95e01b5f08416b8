#include "core/snapshot_stream.hpp"

#include <cstring>
#include <system_error>

namespace quadrille {

SnapshotWriter::SnapshotWriter(const std::filesystem::path& target) : target_(target) {
    std::error_code error;
    const auto status = std::filesystem::status(target_, error);
    if (std::filesystem::exists(status)) {
        // A rename would put a plain file in the place of a folder, a device or a pipe.
        if (!std::filesystem::is_regular_file(status)) {
            throw Error(target_.string() + ": is not a file that a snapshot can replace");
        }
        target_ = std::filesystem::canonical(target_);  // a link stays
    }
    temporary_ = target_;
    temporary_ += ".part";
    out_.open(temporary_, std::ios::binary);
    if (!out_) throw Error(target_.string() + ": cannot be written");
}

SnapshotWriter::~SnapshotWriter() {
    if (committed_) return;
    out_.close();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
}

void SnapshotWriter::write(const void* data, std::size_t size) {
    checksum_.add(data, size);
    out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
}

void SnapshotWriter::text(const std::string& value) {
    number<std::uint64_t>(value.size());
    write(value.data(), value.size());
}

void SnapshotWriter::commit() {
    const std::uint64_t sum = checksum_.value();
    out_.write(reinterpret_cast<const char*>(&sum), sizeof sum);
    out_.close();
    if (!out_) throw Error(target_.string() + ": cannot be written");
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) throw Error(target_.string() + ": " + error.message());
    committed_ = true;
}

SnapshotReader::SnapshotReader(const std::filesystem::path& file) : file_(file.string()) {
    if (std::filesystem::is_directory(file)) fail("is a folder");
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    if (!in) fail("cannot be opened");
    const auto size = static_cast<std::size_t>(in.tellg());
    std::uint64_t expected = 0;
    if (size < sizeof expected) fail("is not a snapshot");
    data_.resize(size);
    in.seekg(0);
    in.read(data_.data(), static_cast<std::streamsize>(size));
    if (!in) fail("cannot be read");
    std::memcpy(&expected, data_.data() + size - sizeof expected, sizeof expected);
    data_.resize(size - sizeof expected);
    Checksum checksum;
    checksum.add(data_.data(), data_.size());
    if (checksum.value() != expected) fail("is damaged or not a snapshot");
}

void SnapshotReader::read(void* data, std::size_t size) {
    if (size > left()) fail("ends too early");
    if (size > 0) std::memcpy(data, data_.data() + at_, size);
    at_ += size;
}

std::string SnapshotReader::text() {
    const auto size = number<std::uint64_t>();
    if (size > left()) fail("ends too early");
    std::string value(size, '\0');
    read(value.data(), size);
    return value;
}

void SnapshotReader::fail(const std::string& reason) const {
    throw SnapshotError(file_ + ": " + reason);
}

}  // namespace quadrille
