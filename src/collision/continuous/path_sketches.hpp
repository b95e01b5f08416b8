#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <quadrille/body_ref.hpp>

#include "collision/pairs/cell_walk.hpp"
#include "collision/rules/paths.hpp"
#include "parallel/thread_team.hpp"

namespace quadrille {

/// What bodies do while a partition covers them.
struct SketchBounds {
    double from, to;  ///< s
    double farthest;  ///< px, from the origin along an axis
    double fastest;   ///< px/s, along an axis
    double largest;   ///< px, half an extent
    double gravity;   ///< px/s^2, along an axis
};

/// The paths of the moving bodies as straight lines in single precision, to see quickly that most
/// candidates do not come near each other: a third of the memory of the paths themselves, and no
/// branch. What is wrong with them is added to the distance that counts as near, so a pair that
/// meets is never left out.
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
        slack_ = slackOf(bounds);
        lines_.resize(rows);
        sizes_.resize(uniform_ ? 1 : rows);
        team.shares(rows, &Thresholds::streamed, [&](std::size_t begin, std::size_t end, unsigned) {
            for (std::size_t i = begin; i < end; ++i) {
                const auto row = static_cast<std::uint32_t>(i);
                redraw(motion, row);
                if (!uniform_) sizes_[i] = sizeOf(motion, row);
            }
        });
        if (uniform_ && rows > 0) sizes_[0] = sizeOf(motion, 0);
    }

    /// Draws the path of a body anew.
    void redraw(const Motion& motion, std::uint32_t row) {
        const auto paths = motion.paths(row);
        lines_[row] = {static_cast<float>(paths.along[0].position(from_)),
                       static_cast<float>(paths.along[1].position(from_)),
                       static_cast<float>(paths.along[0].speed(from_)),
                       static_cast<float>(paths.along[1].speed(from_))};
    }

    /// Calls `function(near)` with those of `others` that may come near the body between two times,
    /// some at once; static ones always may.
    template <class Function>
    void forEachNear(std::uint32_t row, std::span<const BodyRef> others, double now, double to,
                     Function&& function) const {
        constexpr std::size_t block = 32;
        const Span span = spanOf(now, to);
        const Line own = lines_[row];
        const Size size = sizes_[uniform_ ? 0 : row];
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
        const Span span = spanOf(now, to);
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
        return lines_.capacity() * sizeof(Line) + sizes_.capacity() * sizeof(Size);
    }

  private:
    struct Line {
        float x, y, vx, vy;  // px, px/s
    };
    struct Size {
        float halfWidth, halfHeight;  // px
    };
    /// A stretch of time by its middle, from from_, and half its length, s.
    struct Span {
        float middle, half, slack;
    };

    static Size sizeOf(const Motion& motion, std::uint32_t row) {
        const auto& m = motion.bodies.moving;
        return {static_cast<float>(m.halfWidth[row]), static_cast<float>(m.halfHeight[row])};
    }

    /// By how much distances may be wrong: the rounding of positions, speeds, and times, in either
    /// precision, what still counts as touching, and the way of one that falls past one that does
    /// not.
    static float slackOf(const SketchBounds& b) {
        constexpr double eps = 32 * machineEpsilon<float>;
        constexpr double epsTime = 32 * machineEpsilon<double>;
        const double life = b.to - b.from;
        const double speed = b.fastest + b.gravity * life;
        return static_cast<float>(eps * (b.farthest + 2 * speed * life + 2 * b.largest) +
                                  epsTime * 2 * speed * b.to + 4 * touchTolerance * b.largest +
                                  2 * b.gravity * life * life);
    }

    Span spanOf(double now, double to) const {
        return {static_cast<float>((now + to) / 2 - from_), static_cast<float>((to - now) / 2),
                slack_};
    }

    /// What is no number is near, so that whoever knows better looks at it.
    static bool isNear(const Line& a, const Line& b, const Size& sizeA, const Size& sizeB,
                       const Span& span) {
        const float ux = b.vx - a.vx;
        const float uy = b.vy - a.vy;
        const float dx = b.x - a.x + ux * span.middle;
        const float dy = b.y - a.y + uy * span.middle;
        const float x = sizeA.halfWidth + sizeB.halfWidth + span.slack + std::abs(ux) * span.half;
        const float y = sizeA.halfHeight + sizeB.halfHeight + span.slack + std::abs(uy) * span.half;
        return !(std::abs(dx) > x) & !(std::abs(dy) > y);
    }

    bool uniform_ = true;
    double from_ = 0;  // s
    float slack_ = 0;  // px
    std::vector<Line> lines_;
    std::vector<Size> sizes_;  // of all, or one that stands for all
};

}  // namespace quadrille
