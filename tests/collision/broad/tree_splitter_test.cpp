// The nodes that a large quadtree is cut into tile it in Z order, hold each body where it touches
// them, once and in ascending order, and are cut as far as the leaf rule says and no further.

#include "collision/broad/tree_splitter.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include <quadrille/random.hpp>

namespace quadrille {
namespace {

/// The ranges of bodies of several sizes, some of them crowded in a corner.
std::vector<FineRange> randomRanges(std::uint64_t seed, std::size_t count, int maxDepth) {
    Random random(seed);
    const std::int64_t last = (std::int64_t(1) << maxDepth) - 1;
    std::vector<FineRange> ranges;
    for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t most = i % 3 == 0 ? last / 8 : last;
        const std::int64_t extent = i % 50 == 7 ? last / 2 : i % 10 == 3 ? last / 20 : 1;
        const auto begin = [&] { return random.integer(0, most); };
        const auto end = [&](std::int64_t from) {
            return static_cast<std::uint16_t>(std::min(last, from + random.integer(0, extent)));
        };
        const std::int64_t x = begin();
        const std::int64_t y = begin();
        ranges.push_back(
            {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), end(x), end(y)});
    }
    return ranges;
}

std::uint64_t spread(std::uint64_t bits) {
    std::uint64_t result = 0;
    for (int i = 0; i < 16; ++i) result |= (bits >> i & 1) << (2 * i);
    return result;
}

bool touches(const FineRange& range, const TreeNode& node) {
    const std::uint32_t last = (1u << node.shift) - 1;
    return range.x0 <= node.x + last && range.x1 >= node.x && range.y0 <= node.y + last &&
           range.y1 >= node.y;
}

struct Split {
    std::vector<FineRange> ranges;
    std::uint32_t moving;
    int maxDepth;
    std::vector<int> asked;  // how often the range of each body was asked for
    TreeSplitter splitter;
    std::vector<TreeNode> nodes;

    Split(std::vector<FineRange> r, std::uint32_t movingCount, int depth)
        : ranges(std::move(r)), moving(movingCount), maxDepth(depth) {}

    void run(std::size_t maxPerCell, const ThreadTeam& team) {
        asked.assign(ranges.size(), 0);
        std::vector<FineRange> found(ranges.size());
        const auto span = splitter.split(
            found, moving,
            [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                    found[i] = ranges[i];
                    ++asked[i];
                }
            },
            maxDepth, maxPerCell, team);
        nodes.assign(span.begin(), span.end());
    }

    std::size_t placeOf(BodyRef body) const {
        return body.isStatic() ? moving + body.row() : body.row();
    }

    void expectWhole() const {
        ASSERT_EQ(std::count(asked.begin(), asked.end(), 1), std::ptrdiff_t(ranges.size()));
        std::uint64_t code = 0;
        for (const TreeNode& node : nodes) {
            ASSERT_EQ(spread(node.x) | spread(node.y) << 1, code) << "gap, overlap or other order";
            code += std::uint64_t(1) << (2 * node.shift);
            std::size_t next = 0;
            for (std::size_t i = 0; i < ranges.size(); ++i) {
                if (!touches(ranges[i], node)) continue;
                ASSERT_LT(next, node.count);
                const TreeReference& reference = node.references[next++];
                ASSERT_EQ(placeOf(reference.body), i);
                ASSERT_EQ(reference.range.x0, ranges[i].x0);
                ASSERT_EQ(reference.range.y1, ranges[i].y1);
            }
            ASSERT_EQ(next, node.count);
        }
        ASSERT_EQ(code, std::uint64_t(1) << (2 * maxDepth)) << "the nodes do not fill the tree";
    }
};

TEST(TreeSplitter, NodesTileTheTreeAndHoldWhatTouchesThem) {
    for (const unsigned threads : {1u, 2u, 5u}) {
        const ThreadTeam team(threads, Thresholds::none());
        for (const int maxDepth : {0, 1, 4, 10, 15}) {
            for (const std::size_t count : {0, 1, 300, 3000}) {
                for (const std::size_t maxPerCell : {1, 20, 100'000}) {
                    SCOPED_TRACE(std::to_string(threads) + " threads, depth " +
                                 std::to_string(maxDepth) + ", " + std::to_string(count) +
                                 " bodies, " + std::to_string(maxPerCell) + " a cell");
                    Split split(randomRanges(count + maxPerCell, count, maxDepth),
                                static_cast<std::uint32_t>(count - count / 7), maxDepth);
                    split.run(maxPerCell, team);
                    ASSERT_NO_FATAL_FAILURE(split.expectWhole());
                }
            }
        }
    }
}

TEST(TreeSplitter, KeepsNothingOfThePreviousTree) {
    const ThreadTeam team(3, Thresholds::none());
    Split split({}, 0, 10);
    for (const std::size_t count : {5000, 100, 0, 3000, 4}) {
        SCOPED_TRACE(std::to_string(count) + " bodies");
        split.ranges = randomRanges(count, count, 10);
        split.moving = static_cast<std::uint32_t>(count / 2);
        split.run(5, team);
        ASSERT_NO_FATAL_FAILURE(split.expectWhole());
    }
}

TEST(TreeSplitter, LeavesASmallTreeOfOneThreadWhole) {
    Split split(randomRanges(1, 2000, 10), 2000, 10);
    split.run(20, ThreadTeam::serial());
    ASSERT_EQ(split.nodes.size(), 1u);
    EXPECT_EQ(split.nodes[0].shift, 10);
    split.expectWhole();
}

TEST(TreeSplitter, CutsALargeTreeOfOneThreadSoThatThePartsFitItsCache) {
    constexpr std::size_t count = 40'000;
    Split split(randomRanges(1, count, 15), count, 15);
    split.run(20, ThreadTeam::serial());
    EXPECT_GT(split.nodes.size(), 20u);
    // It ends where there are few enough, or on the lowest level that it cuts to at once.
    int lowest = 15;
    for (const TreeNode& node : split.nodes) lowest = std::min(lowest, node.shift);
    EXPECT_GE(lowest, 10);
    for (const TreeNode& node : split.nodes) {
        EXPECT_TRUE(node.shift == lowest || node.count <= 1024) << node.count;
    }
}

TEST(TreeSplitter, DoesNotCutWhatIsALeaf) {
    const ThreadTeam team(2, Thresholds::none());
    constexpr std::size_t count = 3000;
    // All bodies cover the tree: no split could part them.
    Split covered(std::vector<FineRange>(count, FineRange{0, 0, 1023, 1023}), count, 10);
    covered.run(1, team);
    ASSERT_EQ(covered.nodes.size(), 1u);
    covered.expectWhole();
    // A node is cut only if its parent was more than a leaf, or than a part that is small enough.
    Split split(randomRanges(3, count, 10), count, 10);
    split.run(100, team);
    ASSERT_GT(split.nodes.size(), 4u);
    for (std::size_t i = 0; i + 3 < split.nodes.size(); ++i) {
        const TreeNode& first = split.nodes[i];
        const std::uint32_t side = 1u << first.shift;
        if (first.x % (2 * side) != 0 || first.y % (2 * side) != 0) continue;
        const TreeNode parent{nullptr, 0, first.x, first.y, first.shift + 1};
        const auto inside = std::count_if(split.ranges.begin(), split.ranges.end(),
                                          [&](const FineRange& r) { return touches(r, parent); });
        EXPECT_GT(inside, 100);
    }
}

}  // namespace
}  // namespace quadrille
