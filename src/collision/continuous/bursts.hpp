#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "collision/rules/event_order.hpp"
#include "collision/rules/mix64.hpp"

namespace quadrille {

/// Counts how often a body collides practically at once: in one cell of a fixed grid of time, which
/// depends on no step and no window. A body that exactly fits between two others, or is jammed in a
/// crowd, would do so without end.
class Bursts {
  public:
    /// With more, a body is jammed. A row of touching bodies that sorts its velocities needs as
    /// many as it has bodies.
    static constexpr std::uint32_t mostEvents = 1000;
    /// The same for collisions with bodies that are deep inside it.
    static constexpr std::uint32_t mostOverlaps = 64;

    struct Counts {
        std::uint32_t events = 0;
        std::uint32_t overlaps = 0;  ///< those of pairs that are deep inside each other
    };

    /// Counts an event. Returns the counts of its body that has more, this event included.
    Counts note(const PairEvent& event, bool deep) {
        const double cell = std::floor(event.time * cellsPerSecond);
        if (cell != cell_) {
            begin(cell);
            // Nearly all are alone in their cell, and cost no look-up.
            first_ = event;
            firstDeep_ = deep;
            alone_ = true;
            return {1, deep};
        }
        settled();
        return count(event, deep);
    }

    /// For events that are shared out: what each share begins with. The events of a body are all
    /// in one share.
    const Bursts& settled() {
        if (alone_) count(first_, firstDeep_);
        alone_ = false;
        return *this;
    }
    /// Takes over what a share has counted since.
    void take(Bursts& share) {
        if (share.cell_ < cell_) return;
        if (share.cell_ > cell_) begin(share.cell_);
        for (const Entry& entry : share.settled().entries_) {
            if (entry.cell != share.number_) continue;
            Counts& own = countsOf(entry.row);
            own = {std::max(own.events, entry.counts.events),
                   std::max(own.overlaps, entry.counts.overlaps)};
        }
    }

    std::size_t bytes() const { return entries_.capacity() * sizeof(Entry); }

  private:
    // A length of 9e-10 s; a power of 2, so that no rounding is in it.
    static constexpr double cellsPerSecond = 0x1p30;
    static constexpr std::size_t fewEntries = 256;

    /// An entry of a hash table (open addressing, linear probing) that a new cell empties at no
    /// cost.
    struct Entry {
        std::uint64_t cell = 0;  ///< the number that it is of; of another one, it is free
        std::uint32_t row = 0;
        Counts counts;
    };

    void begin(double cell) {
        cell_ = cell;
        alone_ = false;
        ++number_;
        used_ = 0;
        // Shares copy the table.
        if (entries_.size() > fewEntries) entries_ = {};
    }
    Counts count(const PairEvent& event, bool deep) {
        const Counts most = add(event.a, deep);
        if (event.withStatic()) return most;
        const Counts other = add(event.b.row(), deep);
        return {std::max(most.events, other.events), std::max(most.overlaps, other.overlaps)};
    }
    Counts add(std::uint32_t row, bool deep) {
        Counts& counts = countsOf(row);
        ++counts.events;
        counts.overlaps += deep;
        return counts;
    }
    Counts& countsOf(std::uint32_t row) {
        if (2 * used_ >= entries_.size()) grow();
        std::size_t i = mix64(row) & (entries_.size() - 1);
        while (entries_[i].cell == number_ && entries_[i].row != row) {
            i = (i + 1) & (entries_.size() - 1);
        }
        if (entries_[i].cell != number_) {
            entries_[i] = {number_, row, {}};
            ++used_;
        }
        return entries_[i].counts;
    }
    void grow() {
        std::vector<Entry> old(std::max<std::size_t>(16, 2 * entries_.size()));
        old.swap(entries_);
        used_ = 0;
        for (const Entry& entry : old) {
            if (entry.cell == number_) countsOf(entry.row) = entry.counts;
        }
    }

    double cell_ = -1;
    std::uint64_t number_ = 1;  // of the cells so far
    PairEvent first_{};
    bool firstDeep_ = false;
    bool alone_ = false;  // only `first_` has happened in this cell
    std::vector<Entry> entries_;
    std::size_t used_ = 0;
};

}  // namespace quadrille
