#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "collision/broad/partitioner.hpp"

namespace quadrille {

/// How many cells a StaticGrid lays along each axis.
struct GridShape {
    std::uint32_t columns, rows;

    std::uint32_t cells() const { return columns * rows; }
};

/// Throws Error if the cell size is impossible.
GridShape gridShape(const StaticGrid& config, const Vec2& worldSize);

/// Equal cells over the world, filled anew each step by a counting sort. Several threads first sort
/// the bodies into strips of rows, and then the strips one by one.
template <class Real>
class StaticGridPartitioner final : public Partitioner<Real> {
  public:
    StaticGridPartitioner(const StaticGrid& config, const Vec2& worldSize,
                          const ThreadTeam& team = ThreadTeam::serial());

    bool update(const BodyView<Real>& bodies, Real dt, const Reach<Real>& reach) override;

    std::size_t bytes() const override;

  private:
    /// Rows of cells, from the first to before the last, and the bodies that touch them.
    struct Strip {
        std::uint32_t firstRow, lastRow;
        std::size_t firstMember = 0, lastMember = 0;  // in members_
        std::uint64_t entries = 0;
    };

    void layStrips(std::size_t count);
    void sortIntoStrips(const BodyView<Real>& bodies, unsigned workers);
    template <class Member>
    std::uint64_t countRows(const Strip& strip, std::size_t count, Member&& member);
    template <class Member>
    void fillRows(const Strip& strip, std::size_t count, Member&& member, std::uint32_t begin);
    void reserveEntries(std::uint64_t entries);

    template <class Function>
    void forEachCell(const Strip& strip, const FineRange& range, Function&& function) const;
    template <class Function>
    void forEachStrip(const FineRange& range, Function&& function) const;

    std::uint32_t columns_, rows_;
    const ThreadTeam& team_;
    // Where there is more than one strip:
    std::vector<Strip> strips_;
    std::vector<std::uint32_t> stripOfRow_;
    std::vector<std::uint32_t> places_;   // of each worker's members in each strip
    std::vector<std::uint32_t> members_;  // bodies, strip by strip, in ascending order
};

}  // namespace quadrille
