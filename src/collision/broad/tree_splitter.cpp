#include "collision/broad/tree_splitter.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include <quadrille/error.hpp>

namespace quadrille {

namespace {

/// Where there are few references, about four nodes for each worker, but not less than pays.
constexpr std::size_t fewest = 128;
constexpr std::size_t nodesPerWorker = 4;
/// A thread alone cuts trees of so many bodies, which its cache does not hold.
constexpr std::size_t large = 32'768;
/// Levels to go down at once: with 1,365 squares to sort into, the counts stay in the cache.
constexpr int mostLevels = 5;
/// Bodies whose ranges are found and looked at before those of the next.
constexpr std::size_t block = 1024;

/// The squares that a body touches, with a side of 2^shift fine cells: all four coordinates are
/// shifted at once.
FineRange squaresOf(const FineRange& range, int shift) {
    const std::uint64_t kept = (0xffffu >> shift) * 0x0001'0001'0001'0001u;
    return std::bit_cast<FineRange>(std::bit_cast<std::uint64_t>(range) >> shift & kept);
}

bool oneSquare(const FineRange& squares) {
    return squares.x0 == squares.x1 && squares.y0 == squares.y1;
}

template <class Function>
void forEachSquare(const FineRange& squares, Function&& function) {
    for (std::uint32_t y = squares.y0; y <= squares.y1; ++y) {
        for (std::uint32_t x = squares.x0; x <= squares.x1; ++x) function(x, y);
    }
}

TreeNode nodeAt(std::uint32_t x, std::uint32_t y, int shift) {
    return {nullptr, 0, x << shift, y << shift, shift};
}

}  // namespace

std::span<const TreeNode> TreeSplitter::split(std::span<const FineRange> ranges,
                                              std::uint32_t movingCount,
                                              const FindRanges& findRanges, int maxDepth,
                                              std::size_t maxPerCell, const ThreadTeam& team) {
    const std::size_t bodies = ranges.size();
    const unsigned workers = team.workersFor(bodies, &Thresholds::built);
    const std::size_t share = std::max(bodies / (nodesPerWorker * workers), fewest);
    const std::size_t enough = std::max(maxPerCell, std::min(share, team.thresholds().treePart));
    const bool cut = workers > 1 || bodies >= large;
    movingCount_ = movingCount;
    maxDepth_ = maxDepth;
    depth_ = 0;
    while (cut && depth_ < std::min(mostLevels, maxDepth) && (bodies >> 2 * depth_) > 2 * enough)
        ++depth_;

    if (depth_ == 0) return whole(ranges, findRanges, team);

    counts_.resize(workers * stride());
    team.shares(bodies, &Thresholds::built, [&](std::size_t b, std::size_t e, unsigned worker) {
        const Histogram own = histogram(worker);
        std::fill(own.touching, own.touching + 3 * squares(), 0);
        for (std::size_t first = b; first < e; first += block) {
            const std::size_t size = std::min(e - first, block);
            findRanges(first, first + size);
            count(ranges.subspan(first, size), own);
        }
        sumUp(own);
    });
    chooseParts(workers, enough);
    TreeReference* const out = makeRoom(workers);
    team.shares(bodies, &Thresholds::built, [&](std::size_t b, std::size_t e, unsigned worker) {
        place(ranges, b, e, histogram(worker).touching, out);
    });
    return nodes_;
}

/// The root alone.
std::span<const TreeNode> TreeSplitter::whole(std::span<const FineRange> ranges,
                                              const FindRanges& findRanges,
                                              const ThreadTeam& team) {
    TreeReference* const out = references_.reserve(ranges.size());
    team.shares(ranges.size(), &Thresholds::built, [&](std::size_t b, std::size_t e, unsigned) {
        findRanges(b, e);
        for (std::size_t i = b; i < e; ++i) out[i] = referenceOf(ranges, i);
    });
    nodes_.assign(1, {out, ranges.size(), 0, 0, maxDepth_});
    return nodes_;
}

TreeReference TreeSplitter::referenceOf(std::span<const FineRange> ranges, std::size_t i) const {
    const auto k = static_cast<std::uint32_t>(i);
    return {ranges[i], k < movingCount_ ? BodyRef::moving(k) : BodyRef::fixed(k - movingCount_)};
}

TreeSplitter::Histogram TreeSplitter::histogram(unsigned worker) {
    std::uint32_t* const begin = counts_.data() + worker * stride();
    return {begin, begin + squares(), begin + 2 * squares()};
}

/// Counts bodies that touch a single square of the lowest level there, and others in each square of
/// each level.
void TreeSplitter::count(std::span<const FineRange> ranges, const Histogram& own) const {
    for (const FineRange& range : ranges) {
        const FineRange lowest = squaresOf(range, maxDepth_ - depth_);
        if (oneSquare(lowest)) {
            ++own.touching[number(depth_, lowest.x0, lowest.y0)];
            continue;
        }
        for (int level = depth_; level >= 0; --level) {
            const int shift = maxDepth_ - level;
            forEachSquare(squaresOf(range, shift), [&](std::uint32_t x, std::uint32_t y) {
                const std::size_t square = number(level, x, y);
                ++own.several[square];
                own.covering[square] += nodeAt(x, y, shift).coveredBy(range);
            });
        }
    }
}

/// Adds up what count() has counted in two ways.
void TreeSplitter::sumUp(const Histogram& own) const {
    for (int level = depth_ - 1; level >= 0; --level) {
        for (std::size_t y = 0; y < std::size_t(1) << level; ++y) {
            for (std::size_t x = 0; x < std::size_t(1) << level; ++x) {
                const std::uint32_t* const low = own.touching + number(level + 1, 2 * x, 2 * y);
                const std::uint32_t* const high =
                    own.touching + number(level + 1, 2 * x, 2 * y + 1);
                own.touching[number(level, x, y)] = low[0] + low[1] + high[0] + high[1];
            }
        }
    }
    for (std::size_t s = 0; s < squares(); ++s) own.touching[s] += own.several[s];
}

void TreeSplitter::chooseParts(unsigned workers, std::size_t enough) {
    touching_.assign(squares(), 0);
    covering_.assign(squares(), 0);
    for (unsigned worker = 0; worker < workers; ++worker) {
        const Histogram own = histogram(worker);
        for (std::size_t s = 0; s < squares(); ++s) {
            touching_[s] += own.touching[s];
            covering_[s] += own.covering[s];
        }
    }
    parts_.clear();
    partOf_.resize(std::size_t(1) << 2 * depth_);
    addParts(enough, 0, 0, 0);
}

/// In Z order. A part may hold more than a leaf does.
void TreeSplitter::addParts(std::size_t enough, int level, std::uint32_t x, std::uint32_t y) {
    const std::size_t square = number(level, x, y);
    const bool allCover = covering_[square] == touching_[square];
    const auto touching = static_cast<std::size_t>(touching_[square]);
    if (level < depth_ && !isLeaf(touching, enough, maxDepth_ - level, allCover)) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            addParts(enough, level + 1, 2 * x + (k & 1), 2 * y + (k >> 1));
        }
        return;
    }
    const int below = depth_ - level;
    for (std::size_t row = std::size_t(y) << below; row < std::size_t(y + 1) << below; ++row) {
        std::uint32_t* const first = partOf_.data() + (row << depth_) + (std::size_t(x) << below);
        std::fill(first, first + (std::size_t(1) << below),
                  static_cast<std::uint32_t>(parts_.size()));
    }
    parts_.push_back({level, x, y, square});
}

/// Finds where the references of each part begin, and in them each worker's, and makes the nodes.
TreeReference* TreeSplitter::makeRoom(unsigned workers) {
    std::uint64_t next = 0;
    for (const Part& part : parts_) {
        for (unsigned worker = 0; worker < workers; ++worker) {
            std::uint32_t& count = histogram(worker).touching[part.square];
            next += std::exchange(count, static_cast<std::uint32_t>(next));
        }
    }
    if (next > std::numeric_limits<std::uint32_t>::max()) {
        throw Error("quadtree: its nodes hold more references than 32 bits can count");
    }
    TreeReference* const out = references_.reserve(static_cast<std::size_t>(next));
    nodes_.clear();
    std::size_t first = 0;
    for (const Part& part : parts_) {
        TreeNode node = nodeAt(part.x, part.y, maxDepth_ - part.level);
        node.references = out + first;
        node.count = static_cast<std::size_t>(touching_[part.square]);
        first += node.count;
        nodes_.push_back(node);
    }
    return out;
}

/// Writes the references of bodies begin..end to their places.
void TreeSplitter::place(std::span<const FineRange> ranges, std::size_t begin, std::size_t end,
                         std::uint32_t* places, TreeReference* out) const {
    for (std::size_t i = begin; i < end; ++i) {
        const TreeReference reference = referenceOf(ranges, i);
        const FineRange lowest = squaresOf(ranges[i], maxDepth_ - depth_);
        forEachSquare(lowest, [&](std::uint32_t x, std::uint32_t y) {
            const Part& part = parts_[partOf_[(std::size_t(y) << depth_) + x]];
            // A part of several squares gets a reference once: with the first that they share.
            const int below = depth_ - part.level;
            const bool first = x == std::max<std::uint32_t>(lowest.x0, part.x << below) &&
                               y == std::max<std::uint32_t>(lowest.y0, part.y << below);
            if (first) out[places[part.square]++] = reference;
        });
    }
}

std::size_t TreeSplitter::bytes() const {
    return references_.bytes() + nodes_.capacity() * sizeof(TreeNode) +
           (counts_.capacity() + partOf_.capacity()) * sizeof(std::uint32_t) +
           (touching_.capacity() + covering_.capacity()) * sizeof(std::uint64_t) +
           parts_.capacity() * sizeof(Part);
}

}  // namespace quadrille
