#pragma once

#include <cstdint>

#include <quadrille/detail/host_device.hpp>

#include "collision/rules/pair_contact.hpp"
#include "collision/rules/paths.hpp"

/// Paths as straight lines in single precision, to see quickly that most candidates do not come
/// near each other, for host and device alike: a third of the memory of the paths themselves, and
/// no branch. What is wrong with them is added to the distance that counts as near, so a pair that
/// meets is never left out.

namespace quadrille {

/// What bodies do while a partition covers them.
struct SketchBounds {
    double from, to;  ///< s
    double farthest;  ///< px, from the origin along an axis
    double fastest;   ///< px/s, along an axis
    double largest;   ///< px, half an extent
    double gravity;   ///< px/s^2, along an axis
};

/// By how much distances of sketches may be wrong: the rounding of positions, speeds, and times, in
/// either precision, what still counts as touching, and the way of one that falls past one that
/// does not, px.
QUADRILLE_HD inline float sketchSlack(const SketchBounds& b) {
    constexpr double eps = 32 * machineEpsilon<float>;
    constexpr double epsTime = 32 * machineEpsilon<double>;
    const double life = b.to - b.from;
    const double speed = b.fastest + b.gravity * life;
    return static_cast<float>(eps * (b.farthest + 2 * speed * life + 2 * b.largest) +
                              epsTime * 2 * speed * b.to + 4 * touchTolerance * b.largest +
                              2 * b.gravity * life * life);
}

/// A path as seen from a time.
struct alignas(16) PathSketch {
    float x, y, vx, vy;  ///< px, px/s
};

template <class Real, class Path>
QUADRILLE_HD inline PathSketch sketchOf(const ExactMotion<Real, Path>& motion, std::uint32_t row,
                                        double from) {
    const auto paths = motion.paths(row);
    return {static_cast<float>(paths.along[0].position(from)),
            static_cast<float>(paths.along[1].position(from)),
            static_cast<float>(paths.along[0].speed(from)),
            static_cast<float>(paths.along[1].speed(from))};
}

struct SketchSize {
    float halfWidth, halfHeight;  ///< px
};

template <class Real, class Path>
QUADRILLE_HD inline SketchSize sketchSize(const ExactMotion<Real, Path>& motion,
                                          std::uint32_t row) {
    const auto& m = motion.bodies.moving;
    return {static_cast<float>(m.halfWidth[row]), static_cast<float>(m.halfHeight[row])};
}

/// A stretch of time by its middle, after that from which paths are seen, and half its length, s;
/// and the distance beyond that of touching that still is near, px.
struct SketchSpan {
    float middle, half, slack;
};

QUADRILLE_HD inline SketchSpan sketchSpan(double seenFrom, double from, double to, float slack) {
    return {static_cast<float>((from + to) / 2 - seenFrom), static_cast<float>((to - from) / 2),
            slack};
}

/// Whether two bodies may come near each other. What is no number is near, so that whoever knows
/// better looks at it.
QUADRILLE_HD inline bool isNear(const PathSketch& a, const PathSketch& b, const SketchSize& sizeA,
                                const SketchSize& sizeB, const SketchSpan& span) {
    const float ux = b.vx - a.vx;
    const float uy = b.vy - a.vy;
    const float dx = b.x - a.x + ux * span.middle;
    const float dy = b.y - a.y + uy * span.middle;
    const float x = sizeA.halfWidth + sizeB.halfWidth + span.slack + magnitude(ux) * span.half;
    const float y = sizeA.halfHeight + sizeB.halfHeight + span.slack + magnitude(uy) * span.half;
    return !(magnitude(dx) > x) & !(magnitude(dy) > y);
}

}  // namespace quadrille
