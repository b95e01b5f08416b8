#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "collision/rules/event_order.hpp"

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
        for (const auto& [body, counts] : share.settled().counts_) {
            Counts& own = counts_[body];
            own = {std::max(own.events, counts.events), std::max(own.overlaps, counts.overlaps)};
        }
    }

    std::size_t bytes() const {
        return counts_.bucket_count() * sizeof(void*) + counts_.size() * 32;
    }

  private:
    // A length of 9e-10 s; a power of 2, so that no rounding is in it.
    static constexpr double cellsPerSecond = 0x1p30;
    static constexpr std::size_t fewBuckets = 256;

    void begin(double cell) {
        cell_ = cell;
        alone_ = false;
        if (counts_.empty()) return;
        if (counts_.bucket_count() > fewBuckets) {
            counts_ = {};  // emptying many takes long
        } else {
            counts_.clear();
        }
    }
    Counts count(const PairEvent& event, bool deep) {
        const Counts most = add(event.a, deep);
        if (event.withStatic()) return most;
        const Counts other = add(event.b.row(), deep);
        return {std::max(most.events, other.events), std::max(most.overlaps, other.overlaps)};
    }
    Counts add(std::uint32_t row, bool deep) {
        Counts& counts = counts_[row];
        ++counts.events;
        counts.overlaps += deep;
        return counts;
    }

    double cell_ = -1;
    PairEvent first_{};
    bool firstDeep_ = false;
    bool alone_ = false;  // only `first_` has happened in this cell
    std::unordered_map<std::uint32_t, Counts> counts_;
};

}  // namespace quadrille
