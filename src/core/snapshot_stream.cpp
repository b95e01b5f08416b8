#include "core/snapshot_stream.hpp"

#include <cstring>
#include <fstream>

namespace quadrille {

void SnapshotWriter::write(const void* data, std::size_t size) {
    checksum_.add(data, size);
    out_.stream().write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
}

void SnapshotWriter::text(const std::string& value) {
    number<std::uint64_t>(value.size());
    write(value.data(), value.size());
}

void SnapshotWriter::commit() {
    const std::uint64_t sum = checksum_.value();
    out_.stream().write(reinterpret_cast<const char*>(&sum), sizeof sum);
    out_.commit();
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
