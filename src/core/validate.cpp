#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <quadrille/world.hpp>

#include "core/world_access.hpp"

namespace quadrille {

namespace {

/// Enough to see what kind of damage it is.
constexpr std::size_t mostFindings = 20;

class Findings {
  public:
    void add(std::string finding) {
        if (full()) return;
        list_.push_back(list_.size() < mostFindings ? std::move(finding) : "and more");
    }
    bool full() const { return list_.size() > mostFindings; }
    std::vector<std::string> take() { return std::move(list_); }

  private:
    std::vector<std::string> list_;
};

std::string entityName(std::uint32_t index) { return "entity " + std::to_string(index); }

void checkTables(const World& world, Findings& findings) {
    const auto t = WorldAccess::tables(world);
    const std::size_t count = t.generations.size();
    if (t.dead.size() != count || t.slots.size() != count) {
        findings.add("the tables of entities have different lengths");
        return;
    }
    std::vector<bool> gone(count, false);
    const auto take = [&](std::uint32_t index, const char* what) {
        if (index >= count) {
            findings.add(std::string(what) + " entity that does not exist");
        } else if (gone[index]) {
            findings.add(entityName(index) + " is free twice");
        } else if (!t.dead[index]) {
            findings.add(entityName(index) + " is alive and free");
        } else {
            gone[index] = true;
        }
    };
    for (const std::uint32_t index : t.free) {
        take(index, "a free");
        if (index < count && t.slots[index] != BodyRef{}) {
            findings.add(entityName(index) + " is free and has a body");
        }
    }
    for (const Entity entity : t.condemned) take(entity.index, "a destroyed");
    std::size_t dead = 0;
    for (std::size_t i = 0; i < count; ++i) {
        dead += t.dead[i];
        if (t.dead[i] && !gone[i]) findings.add(entityName(std::uint32_t(i)) + " is lost");
    }
    if (count - dead != t.alive) findings.add("the number of living entities is wrong");
}

/// Whether the values of a column of numbers are possible.
template <class Column>
void checkValues(const Column& column, ColumnInfo info, std::span<const std::uint32_t> entity,
                 Findings& findings) {
    if constexpr (std::is_floating_point_v<typename Column::Value>) {
        for (std::size_t i = 0; i < column.size() && !findings.full(); ++i) {
            const bool good = std::isfinite(column[i]) && (!info.positive || column[i] > 0);
            if (good) continue;
            findings.add(entityName(entity[i]) + ": " + info.name +
                         (std::isfinite(column[i]) ? " is not positive" : " is not finite"));
        }
    }
}

template <class Set, class RefOf>
void checkRows(const World& world, const Set& set, const char* kind, RefOf&& refOf,
               Findings& findings) {
    const auto t = WorldAccess::tables(world);
    const std::size_t rows = set.size();
    bool even = true;
    set.forEachColumn(
        [&]<class Column>(ColumnInfo, const Column& column) {
            if constexpr (requires { column.kept(); }) {
                even = even && (!column.kept() || column.stored().size() == rows);
            } else {
                even = even && column.size() == rows;
            }
        },
        set);
    if (!even || (!set.created.view().isRowOrder() && set.created.stored().size() != rows)) {
        findings.add(std::string("the columns of the ") + kind + " bodies have different lengths");
        return;
    }
    for (std::uint32_t i = 0; i < rows && !findings.full(); ++i) {
        const std::uint32_t entity = set.entity[i];
        if (entity >= t.slots.size()) {
            findings.add(std::string("a ") + kind + " body of an entity that does not exist");
        } else if (t.slots[entity] != refOf(i)) {
            findings.add(entityName(entity) + " does not know its body");
        }
    }
    set.forEachColumn(
        [&](ColumnInfo info, const auto& column) {
            checkValues(column, info, set.entity.view(), findings);
        },
        set);
    if (set.created.view().isRowOrder() && set.created.next() != rows) {
        findings.add(std::string("the next creation number of the ") + kind + " bodies is wrong");
    }
    std::vector<std::uint32_t> numbers = set.created.stored();
    std::sort(numbers.begin(), numbers.end());
    if (std::adjacent_find(numbers.begin(), numbers.end()) != numbers.end()) {
        findings.add(std::string("the creation numbers of the ") + kind +
                     " bodies are not all different");
    }
    if (!numbers.empty() && numbers.back() >= set.created.next()) {
        findings.add(std::string("the next creation number of the ") + kind + " bodies is wrong");
    }
}

void checkPools(const World& world, Findings& findings) {
    const auto t = WorldAccess::tables(world);
    const std::size_t count = std::min({t.generations.size(), t.dead.size(), t.slots.size()});
    std::vector<bool> free(count, false);
    for (const std::uint32_t index : t.free) {
        if (index < count) free[index] = true;
    }
    WorldAccess::forEachPool(world, [&](const PoolBase& pool) {
        for (const Entity entity : pool.entities()) {
            if (entity.index >= count || free[entity.index] ||
                t.generations[entity.index] != entity.generation) {
                findings.add("a component of " + entityName(entity.index) +
                             ", which does not exist");
            }
        }
    });
    const auto checkBeside = [&]<class C>() {
        const auto* pool = WorldAccess::findPool<C>(world);
        if (pool == nullptr) return;
        for (const Entity entity : pool->entities()) {
            if (entity.index < count && t.slots[entity.index] != BodyRef{}) {
                findings.add(entityName(entity.index) + " has a component twice");
            }
        }
    };
    checkBeside.template operator()<Transform>();
    checkBeside.template operator()<BoxCollider>();
    checkBeside.template operator()<PhysicsBody>();
}

}  // namespace

std::vector<std::string> World::validate() const {
    Findings findings;
    checkTables(*this, findings);
    const std::size_t known = std::min(slots_.size(), generations_.size());
    std::visit(
        [&](const auto& columns) {
            checkRows(*this, columns.moving, "moving", &BodyRef::moving, findings);
            checkRows(*this, columns.fixed, "static", &BodyRef::fixed, findings);
            for (std::size_t i = 0; i < known && !findings.full(); ++i) {
                const BodyRef body = slots_[i];
                if (body == BodyRef{}) continue;
                const auto owners =
                    body.isStatic() ? columns.fixed.entity.view() : columns.moving.entity.view();
                if (body.row() >= owners.size()) {
                    findings.add(entityName(std::uint32_t(i)) + " has a body that does not exist");
                } else if (owners[body.row()] != i) {
                    findings.add(entityName(std::uint32_t(i)) + " has the body of another one");
                }
            }
        },
        store().columns());
    checkPools(*this, findings);
    return findings.take();
}

}  // namespace quadrille
