#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "collision/rules/event_order.hpp"
#include "collision/rules/event_rules.hpp"
#include "collision/rules/mix64.hpp"

namespace quadrille {

/// Counts how often a body collides practically at once. A body that exactly fits between two
/// others, or is jammed in a crowd, would do so without end. Cells of fixed grids of time, which
/// depend on no step and no window, say what is at once: a short one for all collisions, and a long
/// one for those with what the body touched already when it collided before. What goes to and fro
/// in a row that has nearly no room is not in the former, and would take millions a step.
class Bursts {
  public:
    /// With more collisions in a short cell, or more while touching in a long one, a body is
    /// jammed. A row of touching bodies that sorts its velocities needs as many as it has bodies.
    static constexpr std::uint32_t mostEvents = 1000;
    /// The same for collisions in a short cell with bodies that are deep inside it.
    static constexpr std::uint32_t mostOverlaps = 64;

    /// Of a collision that is none with a body that is touched.
    static constexpr double notTouching = -1;

    /// A collision.
    struct Hit {
        PairEvent event;
        bool deep;        ///< the bodies are deep inside each other
        double touching;  ///< for how long the bodies have touched at most, s
    };
    struct Counts {
        std::uint32_t events = 0;    ///< in the short cell
        std::uint32_t overlaps = 0;  ///< those of pairs that are deep inside each other
        std::uint32_t touches = 0;   ///< in the long cell, while touching
        std::uint32_t held = 0;      ///< the last ones, with static bodies at one instant

        bool jam(bool deep) const {
            return events > mostEvents || touches > mostEvents || held > mostHeld ||
                   (deep && overlaps > mostOverlaps);
        }
    };

    /// Counts a collision. Returns the most that its bodies have, this one included.
    Counts note(const Hit& hit) {
        const double cell = std::floor(hit.event.time * longCellsPerSecond);
        if (cell != cell_) {
            begin(cell);
            // Many are alone in their cell, and cost no look-up.
            first_ = hit;
            alone_ = true;
            return {1, hit.deep, 0, hit.event.withStatic()};
        }
        settled();
        return count(hit);
    }

    /// For events that are shared out: what each share begins with. The events of a body are all
    /// in one share.
    const Bursts& settled() {
        if (alone_) count(first_);
        alone_ = false;
        return *this;
    }
    /// Takes over what a share has counted since.
    void take(Bursts& share) {
        if (share.cell_ < cell_) return;
        if (share.cell_ > cell_) begin(share.cell_);
        for (const Entry& entry : share.settled().entries_) {
            if (entry.cell != share.number_) continue;
            Entry& own = entryOf(entry.row);
            // The share began with what is here.
            if (entry.last >= own.last) own = {number_, entry.row, entry.counts, entry.last};
        }
    }

    std::size_t bytes() const { return entries_.capacity() * sizeof(Entry); }

  private:
    // Lengths of 9e-10 s and 3e-5 s; powers of 2, so that no rounding is in them. What collides
    // more often in long cells has more than the million events a step that are an error.
    static constexpr double cellsPerSecond = 0x1p30;
    static constexpr double longCellsPerSecond = 0x1p15;
    static constexpr double never = -1;
    static constexpr std::size_t fewEntries = 1024;

    /// An entry of a hash table (open addressing, linear probing) that a new long cell empties at
    /// no cost.
    struct Entry {
        std::uint64_t cell = 0;  ///< the number that it is of; of another one, it is free
        std::uint32_t row = 0;
        Counts counts;
        double last = never;  ///< time of the body's last collision, s
    };

    void begin(double cell) {
        cell_ = cell;
        alone_ = false;
        ++number_;
        used_ = 0;
        // Shares copy the table.
        if (entries_.size() > fewEntries) entries_ = {};
    }
    Counts count(const Hit& hit) {
        const Counts most = add(hit.event.a, hit);
        if (hit.event.withStatic()) return most;
        const Counts other = add(hit.event.b.row(), hit);
        return {std::max(most.events, other.events), std::max(most.overlaps, other.overlaps),
                std::max(most.touches, other.touches), 0};
    }
    Counts add(std::uint32_t row, const Hit& hit) {
        Entry& entry = entryOf(row);
        Counts& counts = entry.counts;
        const double now = hit.event.time;
        if (std::floor(now * cellsPerSecond) != std::floor(entry.last * cellsPerSecond)) {
            counts.events = counts.overlaps = 0;
        }
        ++counts.events;
        counts.overlaps += hit.deep;
        counts.touches += entry.last != never && now - entry.last <= hit.touching;
        counts.held = hit.event.withStatic() ? (now == entry.last ? counts.held : 0) + 1 : 0;
        entry.last = now;
        return counts;
    }
    Entry& entryOf(std::uint32_t row) {
        if (2 * used_ >= entries_.size()) grow();
        std::size_t i = static_cast<std::size_t>(mix64(row)) & (entries_.size() - 1);
        while (entries_[i].cell == number_ && entries_[i].row != row) {
            i = (i + 1) & (entries_.size() - 1);
        }
        if (entries_[i].cell != number_) {
            entries_[i] = {number_, row, {}, never};
            ++used_;
        }
        return entries_[i];
    }
    void grow() {
        std::vector<Entry> old(std::max<std::size_t>(16, 2 * entries_.size()));
        old.swap(entries_);
        used_ = 0;
        for (const Entry& entry : old) {
            if (entry.cell == number_) entryOf(entry.row) = entry;
        }
    }

    double cell_ = -1;
    std::uint64_t number_ = 1;  // of the cells so far
    Hit first_{};
    bool alone_ = false;  // only `first_` has happened in this cell
    std::vector<Entry> entries_;
    std::size_t used_ = 0;
};

}  // namespace quadrille
