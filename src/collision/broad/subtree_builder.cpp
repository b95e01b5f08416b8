#include "collision/broad/subtree_builder.hpp"

#include <limits>

#include <quadrille/error.hpp>

namespace quadrille {

void SubtreeBuilder::start(Cells& out, std::size_t maxPerCell, std::size_t room) {
    maxPerCell_ = maxPerCell;
    room_ = room;
    out_ = &out;
    out.offsets.assign(1, 0);
    out.coordinates.clear();
    entries_ = 0;
}

void SubtreeBuilder::finish() { out_->bodies.resize(entries_); }

void SubtreeBuilder::add(const TreeNode& node) {
    if (isLeaf(node.count, maxPerCell_, node.shift, false)) {
        emit(node);
        return;
    }
    ReferenceBuffer& level = levels_[static_cast<std::size_t>(node.shift)];
    if (level.capacity() < 4 * node.count) level.reserve(4 * room_ * node.count);
    const std::size_t stride = level.capacity() / 4;
    std::array<TreeReference*, 4> child;
    for (std::size_t k = 0; k < 4; ++k) child[k] = level.data() + k * stride;
    // Every reference is written to all four lists and kept in those whose quadrant it touches:
    // which ones is a coin toss that a branch would lose.
    std::array<TreeReference*, 4> end = child;
    for (std::size_t i = 0; i < node.count; ++i) {
        const TreeReference r = node.references[i];
        const auto [left, right, low, high] = node.touched(r.range);
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
    // Only where each quadrant holds all bodies can all of them cover the node.
    const bool mayCover = size[0] + size[1] + size[2] + size[3] == 4 * node.count;
    if (isLeaf(node.count, maxPerCell_, node.shift, mayCover && node.covered())) {
        emit(node);
        return;
    }
    for (std::size_t k = 0; k < 4; ++k) add(node.quadrant(k, child[k], size[k]));
}

void SubtreeBuilder::emit(const TreeNode& node) {
    auto& bodies = out_->bodies;
    const std::size_t end = entries_ + node.count;
    if (end > std::numeric_limits<std::uint32_t>::max()) {
        throw Error("quadtree: its cells hold more entries than 32 bits can count");
    }
    if (end > bodies.size()) bodies.resize(std::max(end, bodies.size() + bodies.size() / 2));
    for (std::size_t i = 0; i < node.count; ++i) {
        bodies[entries_ + i] = node.references[i].body;
    }
    entries_ = end;
    out_->offsets.push_back(static_cast<std::uint32_t>(end));
    out_->coordinates.push_back({static_cast<std::uint16_t>(node.x),
                                 static_cast<std::uint16_t>(node.y),
                                 static_cast<std::uint8_t>(node.shift)});
}

std::size_t SubtreeBuilder::bytes() const {
    std::size_t sum = 0;
    for (const ReferenceBuffer& level : levels_) sum += level.bytes();
    return sum;
}

}  // namespace quadrille
