#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace quadrille::reference {

/// A cell of an unbounded uniform grid, in cells from the origin.
struct Cell {
    std::int64_t x = 0;
    std::int64_t y = 0;
    bool operator==(const Cell&) const = default;
};

/// Which boxes have their centre in which cell. A cell is wider than any moving box, so boxes that
/// touch are in the same or in adjacent cells.
class CellGrid {
  public:
    void insert(std::int64_t body, const Cell& cell) { bodies_[cell].push_back(body); }

    void erase(std::int64_t body, const Cell& cell) {
        const auto found = bodies_.find(cell);
        auto& list = found->second;
        list.erase(std::find(list.begin(), list.end(), body));
        if (list.empty()) bodies_.erase(found);
    }

    /// Calls `function(body)` for the bodies of the cells from `low` to `high`, both included.
    template <class Function>
    void each(const Cell& low, const Cell& high, Function&& function) const {
        for (std::int64_t y = low.y; y <= high.y; ++y) {
            for (std::int64_t x = low.x; x <= high.x; ++x) {
                const auto found = bodies_.find({x, y});
                if (found == bodies_.end()) continue;
                for (const std::int64_t body : found->second) function(body);
            }
        }
    }

  private:
    struct Hash {
        std::size_t operator()(const Cell& cell) const {
            const auto x = static_cast<std::uint64_t>(cell.x) * 0x9E3779B97F4A7C15u;
            const auto y = static_cast<std::uint64_t>(cell.y) * 0xC2B2AE3D27D4EB4Fu;
            return static_cast<std::size_t>((x ^ (y >> 7) ^ (y << 57)) + (x >> 29));
        }
    };

    std::unordered_map<Cell, std::vector<std::int64_t>, Hash> bodies_;
};

}  // namespace quadrille::reference
