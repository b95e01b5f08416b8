#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <quadrille/body_ref.hpp>

#include "collision/pairs/cell_walk.hpp"
#include "collision/rules/path_sketch.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// Sketches of the paths of all moving bodies.
template <class Real, class Path>
class PathSketches {
  public:
    using Motion = ExactMotion<Real, Path>;

    /// Draws all paths, as seen from `bounds.from`.
    void draw(const Motion& motion, std::size_t rows, const SketchBounds& bounds,
              const ThreadTeam& team) {
        const auto& half = motion.bodies.moving;
        uniform_ = half.halfWidth.values == nullptr && half.halfHeight.values == nullptr;
        from_ = bounds.from;
        slack_ = sketchSlack(bounds);
        lines_.resize(rows);
        sizes_.resize(uniform_ ? 1 : rows);
        team.shares(rows, &Thresholds::streamed, [&](std::size_t begin, std::size_t end, unsigned) {
            for (std::size_t i = begin; i < end; ++i) {
                const auto row = static_cast<std::uint32_t>(i);
                redraw(motion, row);
                if (!uniform_) sizes_[i] = sketchSize(motion, row);
            }
        });
        if (uniform_ && rows > 0) sizes_[0] = sketchSize(motion, 0);
    }

    /// Draws the path of a body anew.
    void redraw(const Motion& motion, std::uint32_t row) {
        lines_[row] = sketchOf(motion, row, from_);
    }

    /// Calls `function(near)` with those of `others` that may come near the body between two times,
    /// some at once; static ones always may.
    template <class Function>
    void forEachNear(std::uint32_t row, std::span<const BodyRef> others, double now, double to,
                     Function&& function) const {
        constexpr std::size_t block = 32;
        const SketchSpan span = sketchSpan(from_, now, to, slack_);
        const PathSketch own = lines_[row];
        const SketchSize size = sizes_[uniform_ ? 0 : row];
        BodyRef near[block];
        while (!others.empty()) {
            const auto some = others.first(std::min(block, others.size()));
            others = others.subspan(some.size());
            std::size_t count = 0;
            const auto look = [&](auto&& otherSize) {
                for (const BodyRef b : some) {
                    const std::uint32_t other = b.isStatic() ? row : b.row();
                    near[count] = b;
                    count += isNear(own, lines_[other], size, otherSize(other), span);
                }
            };
            if (uniform_) {
                look([&](std::uint32_t) { return size; });
            } else {
                look([&](std::uint32_t other) { return sizes_[other]; });
            }
            if (count > 0) function(std::span<const BodyRef>(near, count));
        }
    }

    /// Calls `function(pair)` for those that may come near each other.
    template <class Function>
    void forEachNear(std::span<const MovingPair> pairs, double now, double to,
                     Function&& function) const {
        constexpr std::size_t block = 64;
        const SketchSpan span = sketchSpan(from_, now, to, slack_);
        MovingPair near[block];
        while (!pairs.empty()) {
            const auto some = pairs.first(std::min(block, pairs.size()));
            pairs = pairs.subspan(some.size());
            std::size_t count = 0;
            const auto look = [&](auto&& sizeOf) {
                for (const MovingPair p : some) {
                    near[count] = p;
                    count += isNear(lines_[p.a], lines_[p.b], sizeOf(p.a), sizeOf(p.b), span);
                }
            };
            if (uniform_) {
                look([size = sizes_[0]](std::uint32_t) { return size; });
            } else {
                look([&](std::uint32_t row) { return sizes_[row]; });
            }
            for (std::size_t i = 0; i < count; ++i) function(near[i]);
        }
    }

    /// Brings the line of a body into the cache.
    void prefetch(std::uint32_t row) const {
#if defined(__GNUC__)
        __builtin_prefetch(lines_.data() + row);
#endif
    }

    std::size_t bytes() const {
        return lines_.capacity() * sizeof(PathSketch) + sizes_.capacity() * sizeof(SketchSize);
    }

  private:
    bool uniform_ = true;
    double from_ = 0;  // s
    float slack_ = 0;  // px
    std::vector<PathSketch> lines_;
    std::vector<SketchSize> sizes_;  // of all, or one that stands for all
};

}  // namespace quadrille
