#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace quadrille {

/// What a reader sees of a Column: the values, or one value that stands for all of them.
template <class T>
struct ColumnView {
    T common{};                 ///< the value of every row while `values` is empty
    std::span<const T> values;  ///< one value a row, or empty

    bool uniform() const { return values.empty(); }
    T operator[](std::size_t row) const { return values.empty() ? common : values[row]; }
};

/// The number of each row in the order of creation.
struct CreationOrder {
    std::span<const std::uint32_t> numbers;  ///< one a row; empty while rows lie in that order

    bool isRowOrder() const { return numbers.empty(); }
    std::uint32_t operator[](std::size_t row) const {
        return numbers.empty() ? static_cast<std::uint32_t>(row) : numbers[row];
    }
};

}  // namespace quadrille
