#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "collision/broad/subtree_builder.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// Cuts a quadtree into nodes that fit the cache and are enough for all threads: a counting sort
/// takes the bodies down several levels of the tree at once.
class TreeSplitter {
  public:
    using FindRanges = std::function<void(std::size_t begin, std::size_t end)>;

    /// The nodes, in Z order, that make up the tree over the bodies with these ranges, of which the
    /// first `movingCount` move: leaves, and
    /// nodes that may still have to be split. They refer to memory of this object. The ranges need
    /// not be there yet: `findRanges` is called to fill them. Throws Error if there are more
    /// references than 32 bits can count.
    std::span<const TreeNode> split(std::span<const FineRange> ranges, std::uint32_t movingCount,
                                    const FindRanges& findRanges, int maxDepth,
                                    std::size_t maxPerCell, const ThreadTeam& team);

    std::size_t bytes() const;

  private:
    /// What a worker counts of its bodies, square by square.
    struct Histogram {
        std::uint32_t* touching;
        std::uint32_t* several;   ///< of these, those that touch other squares of the lowest level
        std::uint32_t* covering;  ///< of these, those that cover all of the square
    };
    /// A square that becomes a node.
    struct Part {
        int level;
        std::uint32_t x, y;
        std::size_t square;
    };

    /// The upper levels of the tree consist of squares: one at level 0, four at level 1, down to
    /// the level depth_. They are numbered level by level, and row by row in each.
    static std::size_t number(int level, std::size_t x, std::size_t y) {
        return ((std::size_t(1) << 2 * level) - 1) / 3 + (y << level) + x;
    }
    std::size_t squares() const { return number(depth_ + 1, 0, 0); }
    /// Numbers that a worker has in counts_; some more than it needs keep the workers apart.
    std::size_t stride() const { return 3 * squares() + 16; }
    Histogram histogram(unsigned worker);
    std::span<const TreeNode> whole(std::span<const FineRange> ranges, const FindRanges& findRanges,
                                    const ThreadTeam& team);
    void count(std::span<const FineRange> ranges, const Histogram& own) const;
    void sumUp(const Histogram& own) const;
    void chooseParts(unsigned workers, std::size_t enough);
    void addParts(std::size_t enough, int level, std::uint32_t x, std::uint32_t y);
    TreeReference* makeRoom(unsigned workers);
    void place(std::span<const FineRange> ranges, std::size_t begin, std::size_t end,
               std::uint32_t* places, TreeReference* out) const;

    TreeReference referenceOf(std::span<const FineRange> ranges, std::size_t i) const;

    std::uint32_t movingCount_ = 0;
    int maxDepth_ = 0;
    int depth_ = 0;
    std::vector<std::uint32_t> counts_;  // the workers' histograms; in the end, of each part, where
                                         // the worker's next reference goes
    std::vector<std::uint64_t> touching_, covering_;  // of all workers
    std::vector<Part> parts_;
    std::vector<std::uint32_t> partOf_;  // of each square of the lowest level
    ReferenceBuffer references_;
    std::vector<TreeNode> nodes_;
};

}  // namespace quadrille
