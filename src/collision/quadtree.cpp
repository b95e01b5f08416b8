#include "collision/quadtree.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include <quadrille/error.hpp>

namespace quadrille {

template <class Real>
QuadtreeBuilder<Real>::QuadtreeBuilder(int maxDepth, int maxPerCell, const Vec2& worldSize)
    : maxDepth_(maxDepth),
      maxPerCell_(static_cast<std::size_t>(maxPerCell)),
      worldSize_(worldSize),
      grid_(-worldSize / 2, worldSize / double(1 << (maxDepth & 15)), 1u << (maxDepth & 15),
            1u << (maxDepth & 15)) {
    if (maxDepth < 0 || maxDepth > 15) throw Error("quadtree: the depth must be from 0 to 15");
    if (maxPerCell < 1) throw Error("quadtree: a cell must be allowed at least one body");
}

template <class Real>
void QuadtreeBuilder<Real>::build(const BodyView<Real>& bodies, Partition<Real>& partition) {
    grid_.ranges(bodies, partition.margin, partition.ranges);
    const std::size_t count = partition.ranges.size();
    if (count > rootCapacity_) {
        root_ = std::make_unique_for_overwrite<Reference[]>(count);
        rootCapacity_ = count;
    }
    for (std::size_t i = 0; i < count; ++i) {
        root_[i] = {partition.ranges[i], static_cast<std::uint32_t>(i)};
    }
    cells_ = &partition.cells;
    cells_->origin = -worldSize_ / 2;
    cells_->fineCell = worldSize_ / double(1 << maxDepth_);
    cells_->offsets.assign(1, 0);
    cells_->coordinates.clear();
    entries_ = 0;
    split(root_.get(), count, 0, 0, maxDepth_);
    cells_->bodies.resize(entries_);
    ++partition.generation;
}

template <class Real>
void QuadtreeBuilder<Real>::split(const Reference* references, std::size_t count, std::uint32_t x,
                                  std::uint32_t y, int shift) {
    if (count <= maxPerCell_ || shift == 0) {
        emit(references, count, x, y, shift);
        return;
    }
    Level& level = levels_[static_cast<std::size_t>(shift)];
    if (count > level.capacity) {
        level.capacity = std::max(count, level.capacity + level.capacity / 2);
        level.children = std::make_unique_for_overwrite<Reference[]>(4 * level.capacity);
    }
    const std::uint32_t half = 1u << (shift - 1);
    const std::uint32_t middleX = x + half;
    const std::uint32_t middleY = y + half;
    std::array<Reference*, 4> child;
    for (std::size_t k = 0; k < 4; ++k) child[k] = level.children.get() + k * level.capacity;
    // Every reference is written to all four lists and kept in those whose quadrant it touches:
    // which ones is a coin toss that a branch would lose.
    std::array<Reference*, 4> end = child;
    for (std::size_t i = 0; i < count; ++i) {
        const Reference r = references[i];
        const std::size_t left = r.range.x0 < middleX;
        const std::size_t right = r.range.x1 >= middleX;
        const std::size_t low = r.range.y0 < middleY;
        const std::size_t high = r.range.y1 >= middleY;
        *end[0] = r;
        *end[1] = r;
        *end[2] = r;
        *end[3] = r;
        end[0] += left & low;
        end[1] += right & low;
        end[2] += left & high;
        end[3] += right & high;
    }
    std::array<std::size_t, 4> size;
    for (std::size_t k = 0; k < 4; ++k) size[k] = static_cast<std::size_t>(end[k] - child[k]);
    if (size[0] + size[1] + size[2] + size[3] == 4 * count) {
        // A node that all its bodies cover gains nothing from any split.
        const std::uint32_t lastX = x + 2 * half - 1;
        const std::uint32_t lastY = y + 2 * half - 1;
        const bool covered = std::all_of(references, references + count, [&](const Reference& r) {
            return r.range.x0 <= x && r.range.x1 >= lastX && r.range.y0 <= y && r.range.y1 >= lastY;
        });
        if (covered) {
            emit(references, count, x, y, shift);
            return;
        }
    }
    split(child[0], size[0], x, y, shift - 1);
    split(child[1], size[1], middleX, y, shift - 1);
    split(child[2], size[2], x, middleY, shift - 1);
    split(child[3], size[3], middleX, middleY, shift - 1);
}

template <class Real>
void QuadtreeBuilder<Real>::emit(const Reference* references, std::size_t count, std::uint32_t x,
                                 std::uint32_t y, int shift) {
    auto& bodies = cells_->bodies;
    const std::size_t end = entries_ + count;
    if (end > std::numeric_limits<std::uint32_t>::max()) {
        throw Error("quadtree: its cells hold more entries than 32 bits can count");
    }
    if (end > bodies.size()) bodies.resize(std::max(end, bodies.size() + bodies.size() / 2));
    for (std::size_t i = 0; i < count; ++i) bodies[entries_ + i] = references[i].body;
    entries_ = end;
    cells_->offsets.push_back(static_cast<std::uint32_t>(end));
    cells_->coordinates.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                                   static_cast<std::uint8_t>(shift)});
}

template <class Real>
std::size_t QuadtreeBuilder<Real>::bytes() const {
    std::size_t references = rootCapacity_;
    for (const Level& level : levels_) references += 4 * level.capacity;
    return references * sizeof(Reference);
}

template class QuadtreeBuilder<double>;
template class QuadtreeBuilder<float>;

}  // namespace quadrille
