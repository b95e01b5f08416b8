#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#include <quadrille/entity.hpp>
#include <quadrille/error.hpp>

namespace quadrille {

/// The entities that have one type of component: a sparse set, so that look-up is two loads,
/// removal swaps with the last, and iteration runs over contiguous memory
/// (Briggs & Torczon 1993, "An efficient representation for sparse sets").
class PoolBase {
  public:
    virtual ~PoolBase() = default;

    /// Throws Error if the components cannot be copied.
    virtual std::unique_ptr<PoolBase> clone() const = 0;

    bool contains(std::uint32_t index) const {
        return index < sparse_.size() && sparse_[index] != Entity::none;
    }
    std::size_t size() const { return dense_.size(); }
    std::span<const Entity> entities() const { return dense_; }

    /// Removes the component of `index` if there is one.
    void erase(std::uint32_t index) {
        if (!contains(index)) return;
        const std::uint32_t row = sparse_[index];
        swapOut(row);
        sparse_[dense_.back().index] = row;
        dense_[row] = dense_.back();
        dense_.pop_back();
        sparse_[index] = Entity::none;
    }

  protected:
    PoolBase() = default;
    PoolBase(const PoolBase&) = default;

    /// Removes row `row` of the values by moving the last one into it.
    virtual void swapOut(std::uint32_t row) = 0;

    void link(Entity entity) {
        if (entity.index >= sparse_.size()) sparse_.resize(entity.index + 1, Entity::none);
        sparse_[entity.index] = static_cast<std::uint32_t>(dense_.size());
        dense_.push_back(entity);
    }
    std::uint32_t row(std::uint32_t index) const { return sparse_[index]; }

  private:
    std::vector<Entity> dense_;
    std::vector<std::uint32_t> sparse_;
};

template <class C>
class Pool final : public PoolBase {
  public:
    /// Adds the component or replaces the one that is there.
    C& put(Entity entity, C value) {
        if (contains(entity.index)) return values_[row(entity.index)] = std::move(value);
        link(entity);
        return values_.emplace_back(std::move(value));
    }
    C& operator[](std::uint32_t index) { return values_[row(index)]; }
    const C& operator[](std::uint32_t index) const { return values_[row(index)]; }

    std::unique_ptr<PoolBase> clone() const override {
        if constexpr (std::is_copy_constructible_v<C>) {
            return std::make_unique<Pool>(*this);
        } else {
            throw Error(std::string("components of type ") + typeid(C).name() +
                        " cannot be copied");
        }
    }

  private:
    void swapOut(std::uint32_t row) override {
        if (row + 1 != values_.size()) values_[row] = std::move(values_.back());
        values_.pop_back();
    }

    std::vector<C> values_;
};

}  // namespace quadrille
