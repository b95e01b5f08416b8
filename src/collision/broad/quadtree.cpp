#include "collision/broad/quadtree.hpp"

#include <algorithm>
#include <limits>

#include <quadrille/error.hpp>

#include "collision/broad/body_ranges.hpp"

namespace quadrille {

template <class Real>
QuadtreeBuilder<Real>::QuadtreeBuilder(int maxDepth, int maxPerCell, const Vec2& worldSize,
                                       const ThreadTeam& team)
    : maxDepth_(maxDepth),
      maxPerCell_(static_cast<std::size_t>(maxPerCell)),
      worldSize_(worldSize),
      team_(team),
      pieces_(team.size()) {
    if (maxDepth < 0 || maxDepth > 15) throw Error("quadtree: the depth must be from 0 to 15");
    if (maxPerCell < 1) throw Error("quadtree: a cell must be allowed at least one body");
}

template <class Real>
void QuadtreeBuilder<Real>::build(const BodyView<Real>& bodies, const Reach<Real>& reach,
                                  Real added, Partition<Real>& partition) {
    const Vec2 fineCell = worldSize_ / double(1 << maxDepth_);
    partition.grid =
        makeFineGrid<Real>(-worldSize_ / 2, fineCell, 1u << maxDepth_, 1u << maxDepth_);
    const std::size_t count = bodies.size();
    partition.beginBuild(bodies, reach, added);
    const auto nodes = splitter_.split(
        partition.ranges, partition.movingCount,
        [&](std::size_t begin, std::size_t end) { findRanges(partition, bodies, begin, end); },
        maxDepth_, maxPerCell_, team_);
    Cells& cells = partition.cells;
    if (team_.workersFor(count, &Thresholds::built) == 1) {
        SubtreeBuilder& builder = pieces_.front().builder;
        builder.start(cells, maxPerCell_);
        for (const TreeNode& node : nodes) builder.add(node);
        builder.finish();
    } else {
        buildPieces(nodes);
        join(cells);
    }
    cells.origin = -worldSize_ / 2;
    cells.fineCell = fineCell;
    ++partition.generation;
}

template <class Real>
void QuadtreeBuilder<Real>::buildPieces(std::span<const TreeNode> nodes) {
    std::size_t total = 0;
    for (const TreeNode& node : nodes) total += node.count;
    std::size_t done = 0;
    std::size_t next = 0;
    for (std::size_t worker = 0; worker < pieces_.size(); ++worker) {
        const std::size_t first = next;
        const bool last = worker + 1 == pieces_.size();
        while (next < nodes.size() && (last || done < total * (worker + 1) / pieces_.size())) {
            done += nodes[next++].count;
        }
        pieces_[worker].nodes = nodes.subspan(first, next - first);
    }
    team_.run(team_.size(), [&](unsigned worker) {
        Piece& piece = pieces_[worker];
        // Room for more than last time, since the worker may get a node more.
        const auto makeRoom = [](auto& column) {
            if (2 * column.size() > column.capacity()) column.reserve(4 * column.size());
        };
        makeRoom(piece.cells.offsets);
        makeRoom(piece.cells.bodies);
        makeRoom(piece.cells.coordinates);
        piece.builder.start(piece.cells, maxPerCell_, 2);
        for (const TreeNode& node : piece.nodes) piece.builder.add(node);
        piece.builder.finish();
    });
}

template <class Real>
void QuadtreeBuilder<Real>::join(Cells& cells) {
    std::size_t cellCount = 0;
    std::size_t entries = 0;
    for (Piece& piece : pieces_) {
        piece.firstCell = cellCount;
        piece.firstEntry = entries;
        cellCount += piece.cells.size();
        entries += piece.cells.bodies.size();
    }
    if (entries > std::numeric_limits<std::uint32_t>::max()) {
        throw Error("quadtree: its cells hold more entries than 32 bits can count");
    }
    cells.offsets.resize(cellCount + 1);
    cells.coordinates.resize(cellCount);
    cells.bodies.resize(entries);
    team_.run(team_.size(), [&](unsigned worker) {
        const Piece& piece = pieces_[worker];
        const auto at = [](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
        std::copy(piece.cells.bodies.begin(), piece.cells.bodies.end(),
                  cells.bodies.begin() + at(piece.firstEntry));
        std::copy(piece.cells.coordinates.begin(), piece.cells.coordinates.end(),
                  cells.coordinates.begin() + at(piece.firstCell));
        const auto shift = static_cast<std::uint32_t>(piece.firstEntry);
        std::transform(piece.cells.offsets.begin(), piece.cells.offsets.end() - 1,
                       cells.offsets.begin() + at(piece.firstCell),
                       [shift](std::uint32_t offset) { return offset + shift; });
    });
    cells.offsets.back() = static_cast<std::uint32_t>(entries);
}

template <class Real>
std::size_t QuadtreeBuilder<Real>::bytes() const {
    std::size_t sum = splitter_.bytes();
    for (const Piece& piece : pieces_) {
        sum += piece.builder.bytes() + piece.cells.offsets.capacity() * sizeof(std::uint32_t) +
               piece.cells.bodies.capacity() * sizeof(BodyRef) +
               piece.cells.coordinates.capacity() * sizeof(CellCoordinates);
    }
    return sum;
}

template class QuadtreeBuilder<double>;
template class QuadtreeBuilder<float>;

}  // namespace quadrille
