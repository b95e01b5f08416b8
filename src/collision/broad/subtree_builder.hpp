#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <quadrille/cells.hpp>

#include "collision/rules/fine_grid.hpp"
#include "collision/rules/leaf_rule.hpp"

namespace quadrille {

/// A body in a node of a quadtree that is being built.
struct TreeReference {
    FineRange range;
    BodyRef body;
};

/// Memory that is not cleared, so that pages are touched only where something is written.
class ReferenceBuffer {
  public:
    /// Makes room for `count` references; what was there is lost.
    TreeReference* reserve(std::size_t count) {
        if (count > capacity_) {
            capacity_ = std::max(count, capacity_ + capacity_ / 2);
            references_ = std::make_unique_for_overwrite<TreeReference[]>(capacity_);
        }
        return references_.get();
    }
    TreeReference* data() const { return references_.get(); }
    std::size_t capacity() const { return capacity_; }
    std::size_t bytes() const { return capacity_ * sizeof(TreeReference); }

  private:
    std::unique_ptr<TreeReference[]> references_;
    std::size_t capacity_ = 0;
};

/// A node: the square of fine cells [x, x + 2^shift) on each axis and the bodies that touch it.
struct TreeNode {
    const TreeReference* references;
    std::size_t count;
    std::uint32_t x, y;
    int shift;

    /// Which of its quadrants a body touches: two bits a axis, low and high.
    struct Touched {
        std::size_t left, right, low, high;
    };
    Touched touched(const FineRange& range) const {
        const std::uint32_t half = 1u << (shift - 1);
        return {range.x0 < x + half, range.x1 >= x + half, range.y0 < y + half,
                range.y1 >= y + half};
    }
    /// Quadrants in Z order: 1 is to the right of 0, 2 above it.
    TreeNode quadrant(std::size_t k, const TreeReference* first, std::size_t size) const {
        const std::uint32_t half = 1u << (shift - 1);
        return {first, size, x + (k & 1 ? half : 0), y + (k & 2 ? half : 0), shift - 1};
    }
    bool coveredBy(const FineRange& range) const { return coversNode(range, x, y, shift); }
    /// Whether all its bodies cover the node entirely: then no split could part them.
    bool covered() const {
        return std::all_of(references, references + count,
                           [&](const TreeReference& r) { return coveredBy(r.range); });
    }
};

/// Builds the leaves of a node in Z order, top down: the part of a quadtree that one thread makes.
class SubtreeBuilder {
  public:
    /// Leaves go to the end of `out`, which begins empty. Of the memory that a node needs, `room`
    /// times as much is reserved, for larger ones to come.
    void start(Cells& out, std::size_t maxPerCell, std::size_t room = 1);
    /// Throws Error if there are more entries than 32 bits can count.
    void add(const TreeNode& node);
    void finish();

    std::size_t bytes() const;

  private:
    void emit(const TreeNode& node);

    std::array<ReferenceBuffer, 16> levels_;  // four child lists each
    std::size_t maxPerCell_ = 1;
    std::size_t room_ = 1;
    Cells* out_ = nullptr;
    std::size_t entries_ = 0;  // in out_->bodies
};

}  // namespace quadrille
