#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <quadrille/body_ref.hpp>
#include <quadrille/creation_ranks.hpp>
#include <quadrille/detail/column.hpp>

namespace quadrille {

/// The kinds of columns that a BodyStore is made of. All have: `grow` for a row more, `move` and
/// `shrink` to close gaps, `permute` (row i becomes what row order[i] was), `reserve` and `bytes`.

namespace detail {

template <class T>
void permute(std::vector<T>& values, std::span<const std::uint32_t> order) {
    if (values.empty()) return;
    std::vector<T> result(values.size());
    for (std::size_t i = 0; i < order.size(); ++i) result[i] = values[order[i]];
    values = std::move(result);
}

}  // namespace detail

/// A value for each row.
template <class T>
class PlainColumn {
  public:
    using Value = T;

    void grow() { values_.push_back(T{}); }
    void set(std::size_t row, T value) { values_[row] = value; }
    void move(std::size_t from, std::size_t to) { values_[to] = values_[from]; }
    void shrink(std::size_t rows) { values_.resize(rows); }
    void permute(std::span<const std::uint32_t> order) { detail::permute(values_, order); }
    void reserve(std::size_t rows) { values_.reserve(rows); }

    T operator[](std::size_t row) const { return values_[row]; }
    std::size_t size() const { return values_.size(); }
    std::size_t bytes() const { return values_.capacity() * sizeof(T); }
    std::span<T> view() { return values_; }
    std::span<const T> view() const { return values_; }

    const std::vector<T>& stored() const { return values_; }
    void store(std::vector<T> values) { values_ = std::move(values); }

  private:
    std::vector<T> values_;
};

/// One number for as long as all rows agree, and an array from the first row that differs.
template <class T>
class Column {
  public:
    using Value = T;

    /// The new row has the common value until it is set.
    void grow() {
        if (!values_.empty()) values_.push_back(common_);
        ++size_;
    }
    void set(std::size_t row, T value) {
        if (values_.empty()) {
            if (size_ == 1) common_ = value;
            if (value == common_) return;
            values_.assign(size_, common_);
        }
        values_[row] = value;
    }
    void move(std::size_t from, std::size_t to) {
        if (!values_.empty()) values_[to] = values_[from];
    }
    void shrink(std::size_t rows) {
        if (!values_.empty()) values_.resize(rows);
        size_ = rows;
    }
    void permute(std::span<const std::uint32_t> order) { detail::permute(values_, order); }
    void reserve(std::size_t) {}

    T operator[](std::size_t row) const { return values_.empty() ? common_ : values_[row]; }
    std::size_t size() const { return size_; }
    std::size_t bytes() const { return values_.capacity() * sizeof(T); }
    ColumnView<T> view() const { return {common_, values_}; }

  private:
    std::size_t size_ = 0;
    T common_{};
    std::vector<T> values_;
};

/// A value for each row, at first T{}, or nothing at all.
template <class T>
class OptionalColumn {
  public:
    using Value = T;

    /// Begins to keep the column, or stops.
    void keep(bool kept, std::size_t rows) {
        if (kept == kept_) return;
        kept_ = kept;
        values_ = std::vector<T>(kept ? rows : 0);
    }
    bool kept() const { return kept_; }

    void grow() {
        if (kept_) values_.emplace_back();
    }
    void move(std::size_t from, std::size_t to) {
        if (kept_) values_[to] = values_[from];
    }
    void shrink(std::size_t rows) {
        if (kept_) values_.resize(rows);
    }
    void permute(std::span<const std::uint32_t> order) { detail::permute(values_, order); }
    void reserve(std::size_t rows) {
        if (kept_) values_.reserve(rows);
    }

    std::size_t bytes() const { return values_.capacity() * sizeof(T); }
    std::span<T> view() { return values_; }

    const std::vector<T>& stored() const { return values_; }
    void store(std::vector<T> values) {
        kept_ = true;
        values_ = std::move(values);
    }

  private:
    bool kept_ = false;
    std::vector<T> values_;
};

/// The numbers of the rows in the order of creation: nothing is stored while rows lie in it.
class CreationColumn {
  public:
    using Value = std::uint32_t;
    /// A BodyRef holds a row, and an event's order a number, in as many bits.
    static constexpr std::uint32_t mostNumbers = BodyRef::mostRows;

    void grow() {
        if (!numbers_.empty()) {
            if (next_ >= mostNumbers) renumber();
            numbers_.push_back(next_);
        }
        ++next_;
        ++size_;
    }
    void move(std::size_t from, std::size_t to) {
        if (!numbers_.empty()) numbers_[to] = numbers_[from];
    }
    void shrink(std::size_t rows) {
        if (!numbers_.empty()) numbers_.resize(rows);
        // Numbers that are not stored are the rows themselves.
        if (numbers_.empty()) next_ = static_cast<std::uint32_t>(rows);
        size_ = rows;
    }
    void permute(std::span<const std::uint32_t> order) {
        std::vector<std::uint32_t> numbers(order.size());
        for (std::size_t i = 0; i < order.size(); ++i) numbers[i] = (*this)[order[i]];
        numbers_ = std::move(numbers);
        if (std::is_sorted(numbers_.begin(), numbers_.end())) {
            numbers_ = {};
            next_ = static_cast<std::uint32_t>(size_);
        }
    }
    void reserve(std::size_t) {}
    /// Stores the numbers, so that rows can leave their order.
    void keepNumbers() {
        if (!numbers_.empty()) return;
        numbers_.resize(size_);
        std::iota(numbers_.begin(), numbers_.end(), 0u);
    }

    std::uint32_t operator[](std::size_t row) const { return view()[row]; }
    std::size_t size() const { return size_; }
    std::size_t bytes() const { return numbers_.capacity() * sizeof(std::uint32_t); }
    CreationOrder view() const { return {numbers_}; }

    /// `numbers` are empty or one a row, each below `next`.
    void store(std::vector<std::uint32_t> numbers, std::size_t rows, std::uint32_t next) {
        numbers_ = std::move(numbers);
        size_ = rows;
        next_ = next;
    }
    std::uint32_t next() const { return next_; }
    const std::vector<std::uint32_t>& stored() const { return numbers_; }

  private:
    /// Closes the gaps that rows which are gone have left. The order stays.
    void renumber() {
        const CreationRanks ranks(view(), size_);
        for (std::size_t i = 0; i < size_; ++i) numbers_[i] = static_cast<std::uint32_t>(ranks[i]);
        next_ = static_cast<std::uint32_t>(size_);
    }

    std::vector<std::uint32_t> numbers_;
    std::size_t size_ = 0;
    std::uint32_t next_ = 0;
};

}  // namespace quadrille
