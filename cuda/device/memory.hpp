#pragma once

#include <cstddef>
#include <utility>

namespace quadrille::cuda {

/// The device memory of one law, so that it can be limited.
struct MemoryBudget {
    std::size_t limit = 0;  ///< bytes; 0 is no limit
    std::size_t used = 0;
};

/// Throw DeviceError, with the bytes wanted and the bytes there, if there is no room.
void* allocateDevice(std::size_t bytes, MemoryBudget& budget);
void freeDevice(void* data, std::size_t bytes, MemoryBudget& budget) noexcept;
void* allocatePinned(std::size_t bytes);
void freePinned(void* data) noexcept;

/// An array in device memory that only grows.
template <class T>
class DeviceArray {
  public:
    explicit DeviceArray(MemoryBudget& budget) : budget_(&budget) {}
    ~DeviceArray() { release(); }
    DeviceArray(const DeviceArray&) = delete;
    DeviceArray& operator=(const DeviceArray&) = delete;

    /// Makes room for `count` elements. Returns whether the array is a new one, whose contents are
    /// undefined. After an exception the array is empty.
    bool reserve(std::size_t count) {
        if (count <= capacity_) return false;
        const std::size_t wanted = capacity_ == 0 ? count : count + count / 4;
        release();
        data_ = static_cast<T*>(allocateDevice(wanted * sizeof(T), *budget_));
        capacity_ = wanted;
        return true;
    }
    T* data() const { return data_; }
    std::size_t capacity() const { return capacity_; }

  private:
    void release() noexcept {
        freeDevice(data_, capacity_ * sizeof(T), *budget_);
        data_ = nullptr;
        capacity_ = 0;
    }

    MemoryBudget* budget_;
    T* data_ = nullptr;
    std::size_t capacity_ = 0;
};

/// An array in page-locked host memory, which the device can reach, that only grows.
template <class T>
class PinnedArray {
  public:
    PinnedArray() = default;
    ~PinnedArray() { freePinned(data_); }
    PinnedArray(const PinnedArray&) = delete;
    PinnedArray& operator=(const PinnedArray&) = delete;

    /// Makes room for `count` elements; a new array has undefined contents.
    void reserve(std::size_t count) {
        if (count <= capacity_) return;
        const std::size_t wanted = capacity_ == 0 ? count : count + count / 4;
        freePinned(std::exchange(data_, nullptr));
        capacity_ = 0;
        data_ = static_cast<T*>(allocatePinned(wanted * sizeof(T)));
        capacity_ = wanted;
    }
    T* data() const { return data_; }
    std::size_t bytes() const { return capacity_ * sizeof(T); }

  private:
    T* data_ = nullptr;
    std::size_t capacity_ = 0;
};

}  // namespace quadrille::cuda
