#include "collision/quadtree.hpp"

#include <algorithm>
#include <limits>

#include <quadrille/error.hpp>

namespace quadrille {

namespace {

/// Nodes to share out for each worker: more even out the work, fewer leave more of it to it.
constexpr std::size_t nodesPerWorker = 4;

}  // namespace

template <class Real>
QuadtreeBuilder<Real>::QuadtreeBuilder(int maxDepth, int maxPerCell, const Vec2& worldSize,
                                       const ThreadTeam& team)
    : maxDepth_(maxDepth),
      maxPerCell_(static_cast<std::size_t>(maxPerCell)),
      worldSize_(worldSize),
      grid_(-worldSize / 2, worldSize / double(1 << (maxDepth & 15)), 1u << (maxDepth & 15),
            1u << (maxDepth & 15)),
      team_(team),
      pieces_(team.size()) {
    if (maxDepth < 0 || maxDepth > 15) throw Error("quadtree: the depth must be from 0 to 15");
    if (maxPerCell < 1) throw Error("quadtree: a cell must be allowed at least one body");
}

template <class Real>
void QuadtreeBuilder<Real>::build(const BodyView<Real>& bodies, Partition<Real>& partition) {
    grid_.ranges(bodies, partition.margin, partition.ranges, team_);
    const std::size_t count = partition.ranges.size();
    TreeReference* const references = root_.reserve(count);
    team_.shares(count, worthwhile::streamed, [&](std::size_t begin, std::size_t end, unsigned) {
        for (std::size_t i = begin; i < end; ++i) {
            references[i] = {partition.ranges[i], static_cast<std::uint32_t>(i)};
        }
    });
    const TreeNode root{references, count, 0, 0, maxDepth_};
    Cells& cells = partition.cells;
    const unsigned workers = team_.workersFor(count, worthwhile::built);
    if (workers == 1) {
        SubtreeBuilder& builder = pieces_.front().builder;
        builder.start(cells, maxPerCell_);
        builder.add(root);
        builder.finish();
    } else {
        const std::size_t enough = count / (nodesPerWorker * workers);
        buildPieces(splitter_.split(root, maxPerCell_, enough, team_));
        join(cells);
    }
    cells.origin = -worldSize_ / 2;
    cells.fineCell = worldSize_ / double(1 << maxDepth_);
    ++partition.generation;
}

template <class Real>
void QuadtreeBuilder<Real>::buildPieces(std::span<const TreeNode> nodes) {
    std::size_t total = 0;
    for (const TreeNode& node : nodes) total += node.count;
    const std::size_t workers = pieces_.size();
    team_.run(team_.size(), [&](unsigned worker) {
        Piece& piece = pieces_[worker];
        piece.builder.start(piece.cells, maxPerCell_);
        std::size_t before = 0;
        for (const TreeNode& node : nodes) {
            // A node goes to the worker in whose share of the references its first one lies; empty
            // ones at the end have none, and go to the last.
            const std::size_t owner = before * workers / std::max<std::size_t>(total, 1);
            if (std::min(owner, workers - 1) == worker) piece.builder.add(node);
            before += node.count;
        }
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
    std::size_t sum = root_.bytes() + splitter_.bytes();
    for (const Piece& piece : pieces_) {
        sum += piece.builder.bytes() + piece.cells.offsets.capacity() * sizeof(std::uint32_t) +
               piece.cells.bodies.capacity() * sizeof(std::uint32_t) +
               piece.cells.coordinates.capacity() * sizeof(CellCoordinates);
    }
    return sum;
}

template class QuadtreeBuilder<double>;
template class QuadtreeBuilder<float>;

}  // namespace quadrille
