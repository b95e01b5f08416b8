#include "core/snapshot_stream.hpp"

#include <cstring>

#include "system/input_file.hpp"
#include "system/memory.hpp"

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
    std::uint64_t sum = checksum_.value();
    toFileOrder(sum);
    out_.stream().write(reinterpret_cast<const char*>(&sum), sizeof sum);
    out_.commit();
}

SnapshotReader::SnapshotReader(const std::filesystem::path& file) : file_(file.string()) {
    try {
        data_ = readRegularFile(file, memoryOfMachine());
    } catch (const Error& error) {
        fail(error.what());
    }
    const std::size_t size = data_.size();
    std::uint64_t expected = 0;
    if (size < sizeof expected) fail("is not a snapshot");
    std::memcpy(&expected, data_.data() + size - sizeof expected, sizeof expected);
    toFileOrder(expected);
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
    std::string value(static_cast<std::size_t>(size), '\0');
    read(value.data(), value.size());
    return value;
}

void SnapshotReader::fail(const std::string& reason) const {
    throw SnapshotError(file_ + ": " + reason);
}

}  // namespace quadrille
