#pragma once

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

#include <quadrille/body_ref.hpp>
#include <quadrille/error.hpp>

#include "collision/rules/bodies.hpp"
#include "system/whole_file.hpp"

namespace quadrille {

/// FNV-1a, 64 bits (Fowler, Noll & Vo): finds damage, not malice.
class Checksum {
  public:
    void add(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3u;
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

template <class T>
concept PlainNumber = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Numbers side by side, without gaps whose bytes nobody sets.
template <class T>
concept PlainRow = PlainNumber<T> || std::same_as<T, BodyRef> || std::same_as<T, Anchor<double>> ||
    std::same_as<T, Anchor<float>>;

static_assert(sizeof(BodyRef) == 4 && sizeof(Anchor<double>) == 56 && sizeof(Anchor<float>) == 40,
              "rows go to files as they lie in memory");

/// From the machine's byte order to that of files, which have the lowest byte first, and back. In
/// place: a number whose bytes are turned is none that could be passed on.
template <PlainNumber T>
void toFileOrder(T& number) {
    if constexpr (std::endian::native != std::endian::little) {
        auto* const bytes = reinterpret_cast<unsigned char*>(&number);
        std::reverse(bytes, bytes + sizeof number);
    }
}
inline void toFileOrder(BodyRef& body) { toFileOrder(body.bits); }
template <class Real>
void toFileOrder(Anchor<Real>& a) {
    for (Real* const value : {&a.x, &a.y, &a.vx, &a.vy}) toFileOrder(*value);
    for (double* const time : {&a.timeX, &a.timeY}) toFileOrder(*time);
    for (float* const low : {&a.lowX, &a.lowY}) toFileOrder(*low);
}
template <PlainRow T>
void toFileOrder(std::vector<T>& rows) {
    for (T& row : rows) toFileOrder(row);
}

/// Writes a file that has the same bytes whatever machine it is written on, and appears whole or
/// not at all.
class SnapshotWriter {
  public:
    explicit SnapshotWriter(const std::filesystem::path& target) : out_(target) {}

    void write(const void* data, std::size_t size);
    template <PlainNumber T>
    void number(T value) {
        toFileOrder(value);
        write(&value, sizeof value);
    }
    template <PlainRow T>
    void numbers(const std::vector<T>& values) {
        number<std::uint64_t>(values.size());
        if constexpr (std::endian::native == std::endian::little) {
            write(values.data(), values.size() * sizeof(T));
        } else {
            std::vector<T> turned = values;
            toFileOrder(turned);
            write(turned.data(), turned.size() * sizeof(T));
        }
    }
    void text(const std::string& value);

    /// Appends the checksum and gives the file its name. Throws Error if anything failed.
    void commit();

  private:
    WholeFile out_;
    Checksum checksum_;
};

/// Reads what SnapshotWriter wrote; throws SnapshotError where the data end too early.
class SnapshotReader {
  public:
    /// Reads the whole file and verifies its checksum.
    explicit SnapshotReader(const std::filesystem::path& file);

    void read(void* data, std::size_t size);
    template <PlainNumber T>
    T number() {
        T value;
        read(&value, sizeof value);
        toFileOrder(value);
        return value;
    }
    template <PlainRow T>
    std::vector<T> numbers() {
        const auto size = number<std::uint64_t>();
        if (size > left() / sizeof(T)) fail("ends too early");
        std::vector<T> values(static_cast<std::size_t>(size));
        read(values.data(), values.size() * sizeof(T));
        if constexpr (std::endian::native != std::endian::little) toFileOrder(values);
        return values;
    }
    std::string text();
    std::size_t left() const { return data_.size() - at_; }

    [[noreturn]] void fail(const std::string& reason) const;

  private:
    std::string file_;
    std::string data_;
    std::size_t at_ = 0;
};

}  // namespace quadrille
