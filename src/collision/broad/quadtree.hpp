#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "collision/broad/partitioner.hpp"
#include "collision/broad/subtree_builder.hpp"
#include "collision/broad/tree_splitter.hpp"

namespace quadrille {

/// Builds the leaves of a quadtree, in Z order, top down. Bodies are quantised once to the cells of
/// the deepest level, so every decision of the tree is a comparison of integers. A large tree is
/// cut into nodes first, by all threads at once; then every thread builds some of these.
template <class Real>
class QuadtreeBuilder {
  public:
    /// Throws Error unless 0 <= maxDepth <= 15 and maxPerCell >= 1.
    QuadtreeBuilder(int maxDepth, int maxPerCell, const Vec2& worldSize, const ThreadTeam& team);

    /// Replaces the partition's cells by the leaves for boxes inflated by their reach and what is
    /// added to it.
    void build(const BodyView<Real>& bodies, const Reach<Real>& reach, Real added,
               Partition<Real>& partition);

    std::size_t bytes() const;

  private:
    /// Neighbouring leaves that one thread builds.
    struct alignas(64) Piece {
        std::span<const TreeNode> nodes;
        SubtreeBuilder builder;
        Cells cells;
        std::size_t firstCell = 0, firstEntry = 0;  // in the whole
    };

    void buildPieces(std::span<const TreeNode> nodes);
    void join(Cells& cells);

    int maxDepth_;
    std::size_t maxPerCell_;
    Vec2 worldSize_;
    const ThreadTeam& team_;
    TreeSplitter splitter_;
    std::vector<Piece> pieces_;  // one a worker; a single one writes to the partition itself
};

/// A quadtree that is built anew each step.
template <class Real>
class QuadtreePartitioner final : public Partitioner<Real> {
  public:
    QuadtreePartitioner(const Quadtree& config, const Vec2& worldSize,
                        const ThreadTeam& team = ThreadTeam::serial())
        : builder_(config.maxDepth, config.maxPerCell, worldSize, team) {}

    bool update(const BodyView<Real>& bodies, Real, const Reach<Real>& reach) override {
        builder_.build(bodies, reach, 0, this->partition_);
        return true;
    }

    std::size_t bytes() const override { return this->partition_.bytes() + builder_.bytes(); }

  private:
    QuadtreeBuilder<Real> builder_;
};

}  // namespace quadrille
