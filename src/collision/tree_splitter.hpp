#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "collision/subtree_builder.hpp"
#include "collision/thread_team.hpp"

namespace quadrille {

/// Splits the upper nodes of a quadtree on all threads, until what is left is small enough to be
/// shared out: one level of the tree at a time, all nodes of the level at once.
class TreeSplitter {
  public:
    /// The nodes, in Z order, that make up `root`: leaves, and nodes of up to `enough` bodies that
    /// may still have to be split. They refer to the root's references and to memory of this
    /// object.
    std::span<const TreeNode> split(const TreeNode& root, std::size_t maxPerCell,
                                    std::size_t enough, const ThreadTeam& team);

    std::size_t bytes() const;

  private:
    /// A part of a node's references, and where its contributions to the four quadrants begin: at
    /// first how many they are.
    struct Block {
        std::size_t node;
        std::size_t begin, end;
        std::array<std::size_t, 4> out;
    };

    void cutIntoBlocks();
    void splitLevel(ReferenceBuffer& memory, const ThreadTeam& team);

    std::array<ReferenceBuffer, 16> levels_;  // references of the nodes of a level
    std::vector<TreeNode> open_, next_;       // to be split, and what they are split into
    std::vector<TreeNode> done_;
    std::vector<Block> blocks_;
};

}  // namespace quadrille
