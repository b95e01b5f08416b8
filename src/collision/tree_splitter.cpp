#include "collision/tree_splitter.hpp"

#include <algorithm>
#include <utility>

namespace quadrille {

namespace {

constexpr std::size_t blockSize = 4096;  // references

/// Spreads the 16 low bits over the even places.
std::uint32_t spread(std::uint32_t v) {
    v = (v | (v << 8)) & 0x00ff'00ffu;
    v = (v | (v << 4)) & 0x0f0f'0f0fu;
    v = (v | (v << 2)) & 0x3333'3333u;
    return (v | (v << 1)) & 0x5555'5555u;
}

/// Place of a node in Z order, of nodes that do not overlap.
std::uint32_t zOrder(const TreeNode& node) { return spread(node.x) | (spread(node.y) << 1); }

}  // namespace

std::span<const TreeNode> TreeSplitter::split(const TreeNode& root, std::size_t maxPerCell,
                                              std::size_t enough, const ThreadTeam& team) {
    done_.clear();
    open_.clear();
    const auto sortOut = [&](const TreeNode& node) {
        const bool small = node.count <= std::max(enough, maxPerCell) || node.shift == 0;
        (small ? done_ : open_).push_back(node);
    };
    sortOut(root);
    for (int shift = root.shift; !open_.empty(); --shift) {
        splitLevel(levels_[static_cast<std::size_t>(shift)], team);
        open_.clear();
        for (const TreeNode& node : next_) sortOut(node);
    }
    std::sort(done_.begin(), done_.end(),
              [](const TreeNode& p, const TreeNode& q) { return zOrder(p) < zOrder(q); });
    return done_;
}

void TreeSplitter::cutIntoBlocks() {
    blocks_.clear();
    for (std::size_t n = 0; n < open_.size(); ++n) {
        for (std::size_t begin = 0; begin < open_[n].count; begin += blockSize) {
            blocks_.push_back({n, begin, std::min(open_[n].count, begin + blockSize), {}});
        }
    }
}

/// A stable counting sort of the references of every open node into its quadrants, as one thread
/// would do it.
void TreeSplitter::splitLevel(ReferenceBuffer& memory, const ThreadTeam& team) {
    cutIntoBlocks();
    team.shares(blocks_.size(), 2, [&](std::size_t first, std::size_t last, unsigned) {
        for (std::size_t b = first; b < last; ++b) {
            Block& block = blocks_[b];
            const TreeNode& node = open_[block.node];
            std::array<std::size_t, 4> count{};
            for (std::size_t i = block.begin; i < block.end; ++i) {
                const auto [left, right, low, high] = node.touched(node.references[i].range);
                count[0] += left & low;
                count[1] += right & low;
                count[2] += left & high;
                count[3] += right & high;
            }
            block.out = count;
        }
    });

    // Node by node and quadrant by quadrant: where each list begins, and in it each block.
    next_.clear();
    std::size_t place = 0;
    for (std::size_t begin = 0, end; begin < blocks_.size(); begin = end) {
        const std::size_t n = blocks_[begin].node;
        for (end = begin; end < blocks_.size() && blocks_[end].node == n;) ++end;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t start = place;
            for (std::size_t b = begin; b < end; ++b) {
                place += std::exchange(blocks_[b].out[k], place);
            }
            next_.push_back(open_[n].quadrant(k, nullptr, place - start));
        }
    }
    TreeReference* const out = memory.reserve(place);
    place = 0;
    for (TreeNode& node : next_) {
        node.references = out + place;
        place += node.count;
    }

    team.shares(blocks_.size(), 2, [&](std::size_t first, std::size_t last, unsigned) {
        for (std::size_t b = first; b < last; ++b) {
            Block& block = blocks_[b];
            const TreeNode& node = open_[block.node];
            for (std::size_t i = block.begin; i < block.end; ++i) {
                const TreeReference& r = node.references[i];
                const auto [left, right, low, high] = node.touched(r.range);
                if (left & low) out[block.out[0]++] = r;
                if (right & low) out[block.out[1]++] = r;
                if (left & high) out[block.out[2]++] = r;
                if (right & high) out[block.out[3]++] = r;
            }
        }
    });
    // As a thread alone would: what all its bodies cover stays in one piece.
    for (std::size_t n = 0; n < open_.size(); ++n) {
        const auto quadrants = next_.begin() + static_cast<std::ptrdiff_t>(4 * n);
        const bool all = std::all_of(quadrants, quadrants + 4,
                                     [&](const TreeNode& q) { return q.count == open_[n].count; });
        if (all && open_[n].covered()) {
            done_.push_back(open_[n]);
            // Left without bodies and marked to be dropped.
            for (auto q = quadrants; q != quadrants + 4; ++q) q->references = nullptr;
        }
    }
    std::erase_if(next_, [](const TreeNode& node) { return node.references == nullptr; });
}

std::size_t TreeSplitter::bytes() const {
    std::size_t sum = (open_.capacity() + next_.capacity() + done_.capacity()) * sizeof(TreeNode) +
                      blocks_.capacity() * sizeof(Block);
    for (const ReferenceBuffer& level : levels_) sum += level.bytes();
    return sum;
}

}  // namespace quadrille
