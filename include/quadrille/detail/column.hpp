#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace quadrille {

/// What a reader sees of a Column: the values, or one value that stands for all of them.
template <class T>
struct ColumnView {
    T common{};                 ///< the value of every row while `values` is empty
    std::span<const T> values;  ///< one value a row, or empty

    bool uniform() const { return values.empty(); }
    T operator[](std::size_t row) const { return values.empty() ? common : values[row]; }
};

/// A column that stores one number for as long as all rows agree, and an array from the first row
/// that differs.
template <class T>
class Column {
  public:
    void push_back(T value) {
        if (size_ == 0) common_ = value;
        if (values_.empty() && value != common_) values_.assign(size_, common_);
        if (!values_.empty() || value != common_) values_.push_back(value);
        ++size_;
    }

    void set(std::size_t row, T value) {
        if (values_.empty()) {
            if (value == common_) return;
            values_.assign(size_, common_);
        }
        values_[row] = value;
    }

    /// Moves the value of row `from` to row `to`; used to close gaps, followed by `resize`.
    void move(std::size_t from, std::size_t to) {
        if (!values_.empty()) values_[to] = values_[from];
    }

    void shrink(std::size_t size) {
        if (!values_.empty()) values_.resize(size);
        size_ = size;
    }

    T operator[](std::size_t row) const { return values_.empty() ? common_ : values_[row]; }
    std::size_t size() const { return size_; }
    std::size_t bytes() const { return values_.capacity() * sizeof(T); }
    ColumnView<T> view() const { return {common_, values_}; }

  private:
    std::size_t size_ = 0;
    T common_{};
    std::vector<T> values_;
};

}  // namespace quadrille
