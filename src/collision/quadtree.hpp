#pragma once

#include <array>
#include <memory>

#include "collision/partitioner.hpp"

namespace quadrille {

/// Builds the leaves of a quadtree, in Z order, top down. Bodies are quantised once to the cells of
/// the deepest level, so every decision of the tree is a comparison of integers.
template <class Real>
class QuadtreeBuilder {
  public:
    /// Throws Error unless 0 <= maxDepth <= 15 and maxPerCell >= 1.
    QuadtreeBuilder(int maxDepth, int maxPerCell, const Vec2& worldSize);

    /// Replaces the partition's cells by the leaves for boxes inflated by partition.margin.
    void build(const BodyView<Real>& bodies, Partition<Real>& partition);

    std::size_t bytes() const;

  private:
    struct Reference {
        FineRange range;
        std::uint32_t body;
    };
    /// Memory that is not cleared: a level's four child lists lie `capacity` apart and are mostly
    /// shorter, so that most of the pages are never touched.
    struct Level {
        std::unique_ptr<Reference[]> children;
        std::size_t capacity = 0;  ///< of one child list
    };

    void split(const Reference* references, std::size_t count, std::uint32_t x, std::uint32_t y,
               int shift);
    void emit(const Reference* references, std::size_t count, std::uint32_t x, std::uint32_t y,
              int shift);

    int maxDepth_;
    std::size_t maxPerCell_;
    Vec2 worldSize_;
    FineGrid<Real> grid_;
    std::unique_ptr<Reference[]> root_;
    std::size_t rootCapacity_ = 0;
    std::array<Level, 16> levels_;
    Cells* cells_ = nullptr;   // being built
    std::size_t entries_ = 0;  // in cells_->bodies
};

/// A quadtree that is built anew each step.
template <class Real>
class QuadtreePartitioner final : public Partitioner<Real> {
  public:
    QuadtreePartitioner(const Quadtree& config, const Vec2& worldSize)
        : builder_(config.maxDepth, config.maxPerCell, worldSize) {}

    bool update(const BodyView<Real>& bodies, Real, Real reach) override {
        this->partition_.margin = reach;
        builder_.build(bodies, this->partition_);
        return true;
    }

    std::size_t bytes() const override { return this->partition_.bytes() + builder_.bytes(); }

  private:
    QuadtreeBuilder<Real> builder_;
};

}  // namespace quadrille
